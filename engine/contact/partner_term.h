#pragma once
#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "engine/contact/coulomb.h"
#include "engine/contact/face_contact.h"
#include "engine/contact/partner.h"
#include "engine/contact/remembered_tractions.h"

namespace burnish::inline contact {

/// Contact of one face ("slave") with a partner, with Coulomb friction: what methods have in common that have one
/// rule for all states of a step.
///
/// Penalties have no multipliers. In their place, the traction of friction goes on from that of the accepted
/// state, which the term remembers: what sticks slips elastically, by the traction's change over ε_T.
template <int Dim>
class PartnerTerm : public FaceContact<Dim> {
 public:
  [[nodiscard]] bool evaluate(double t, const Eigen::VectorXd& x, Assembly& out) final;
  bool hasSymmetricTangent() const override { return !hasFriction_; }
  void accept() final;
  void archive(StateArchive& archive) final;

 protected:
  using Tangential = Eigen::Vector<double, Dim - 1>;
  using Components = typename RememberedTractions<Dim>::Components;

  /// How tractions are remembered that the term has by function or by quadrature point.
  enum class TractionsOf { Functions, Points };

  /// options, firstMultiplier, definitions: as of the methods. Sets `weights` to those of penalties.
  PartnerTerm(const Body<Dim>& body, int patch, FaceId face, const PartnerMaker<Dim>& makePartner,
              const ContactOptions& options, int firstMultiplier,
              const std::vector<DefinitionSpec>& definitions, TractionsOf tractions);

  /// Adds residual and tangent at a state that the partner knows; calls `addResultants` for the points of its
  /// rule and `reportPoint` for the face's quadrature points; what else there is to say goes to `state_`, with
  /// the integral of the pressure. positions: of the quadrature points. False if the state is not admissible.
  [[nodiscard]] virtual bool assemble(double t, const Eigen::VectorXd& x, const Eigen::MatrixXd& positions,
                                      Assembly& out) = 0;

  /// The partner may have other segments: a state has been accepted or restored.
  virtual void takeSegments() {}

  /// Tractions of friction of the last evaluation by function or by point, in the frames of its step; asked
  /// for with a penalty and friction.
  virtual Components lastTractions() const = 0;

  using Span = typename FaceQuadrature<Dim>::Span;

  /// Unknowns that points of a span depend on, ascending.
  std::vector<int> spanCouplings(std::size_t e) const;

  SlavePoint<Dim> pointAt(std::size_t e, Eigen::Index q, const Eigen::MatrixXd& positions) const;

  /// A point of a rule on a span. number: of the face's quadrature points, -1 between them.
  SlavePoint<Dim> pointAt(std::size_t e, const Span& rule, Eigen::Index q, int number,
                          const Eigen::Ref<const Eigen::VectorXd>& position) const;

  /// Stretch of the face's area at a point of a rule on a span in the accepted state if the law of friction
  /// needs it, else zero.
  double acceptedStretch(std::size_t e, const Span& rule, Eigen::Index q) const;

  /// Adds what a point bears to the resultants: λ̂ <= 0 along the normal, a traction along the frame.
  void addResultants(const SlavePoint<Dim>& slave, double weight, const ContactPoint<Dim>& point,
                     double lambdaHat, const Tangential& traction);

  /// What one of the face's quadrature points bears, and whether it slips.
  void reportPoint(const SlavePoint<Dim>& slave, const ContactPoint<Dim>& point, double lambdaHat,
                   const Tangential& traction, bool slips);

  using FaceContact<Dim>::face_;
  using FaceContact<Dim>::options_;
  using FaceContact<Dim>::axisymmetric_;
  using FaceContact<Dim>::A_;
  using FaceContact<Dim>::state_;
  using FaceContact<Dim>::frictionLaw_;
  using FaceContact<Dim>::slipped_;
  using FaceContact<Dim>::work_;

  std::unique_ptr<Partner<Dim>> partner_;
  bool hasFriction_;
  std::vector<std::vector<int>> slaveUnknowns_;  ///< per span: displacement components, by functions

  /// What gaps are counted less by with a penalty: more than rounding explains, so that all that touches when a
  /// step begins is pressed and sticks at first. What rounding chooses of it makes Newton's method fail where
  /// parameters are large, however small the step is. Zero without a penalty.
  double touching_;
  RememberedTractions<Dim> remembered_;

 private:
  bool remembers() const { return hasFriction_ && isPenalty(options_.method); }
  Eigen::MatrixXd acceptedPoints(std::size_t e) const;
  Components directionsOfFace() const;

  TractionsOf tractionsOf_;
};

}  // namespace burnish::inline contact
