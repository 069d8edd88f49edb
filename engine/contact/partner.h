#pragma once
#include <Eigen/Dense>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/contact/contact_point.h"
#include "engine/contact/segments.h"
#include "engine/core/state_archive.h"
#include "engine/solid/face_quadrature.h"

namespace burnish::inline contact {

/// What is wanted of a contact point: gap and normal, with first, with second derivatives of the gap.
enum class PointDetail { Gap, Derivatives, SecondDerivatives };

/// A point of a contact face ("slave") that asks for its partner.
template <int Dim>
struct SlavePoint {
  std::size_t span = 0;                  ///< of the face
  int number = -1;                       ///< of the face's quadrature points; -1 between them
  Eigen::Vector<double, Dim - 1> xi;     ///< parameters of the face's trace
  std::span<const int> unknowns;         ///< displacement components of the span's functions
  Eigen::Ref<const Eigen::VectorXd> R;   ///< values of these functions
  Eigen::Vector<double, Dim> x;          ///< current position
  Eigen::Vector<double, Dim> xAccepted;  ///< position in the last accepted state; needed for slip alone
};

/// What a face may touch: a rigid tool, or faces of bodies.
template <int Dim>
class Partner {
 public:
  virtual ~Partner() = default;

  /// The partner at the time t and the unknowns x; positions: current ones of the face's quadrature points,
  /// Dim x points. False if the state is not admissible.
  [[nodiscard]] virtual bool update(double t, const Eigen::VectorXd& x, const Eigen::MatrixXd& positions) = 0;

  /// Gap and normal at a point in the last updated state, and as much more as is wanted; none if the point
  /// has no partner.
  virtual std::optional<ContactPoint<Dim>> at(const SlavePoint<Dim>& point, PointDetail detail) const = 0;

  /// Adds frame, slip and its derivatives to what `at` has answered with derivatives.
  virtual void addSlip(const SlavePoint<Dim>& point, ContactPoint<Dim>& contact) const = 0;

  /// ∂(Σ t_α e_α · δs_T) by the unknowns for traction components t_α that do not change: rows of the
  /// variation, columns of the increment; after `addSlip`.
  virtual Eigen::MatrixXd frictionTangent(const SlavePoint<Dim>& point, const ContactPoint<Dim>& contact,
                                          const Eigen::Vector<double, Dim - 1>& traction) const = 0;

  /// Unknowns of the partner that points of a span may be coupled with until the next accepted state,
  /// ascending.
  virtual std::vector<int> couplings(std::size_t span) const = 0;

  /// Segments of a span, begin to end, that quadrature is to be split into until the next accepted state; none
  /// if it is not to be split.
  virtual std::vector<Segment> segments(std::size_t) const { return {}; }

  /// Unknowns of free turns.
  virtual std::vector<int> freeTurns() const { return {}; }

  /// Point about which the moment of the forces on the partner is taken, in the last updated state.
  virtual Eigen::Vector3d pivot() const = 0;

  /// Work that a force on the partner, with its moment about the pivot, does on the prescribed motion of the
  /// partner since the accepted state.
  virtual double prescribedWork(const Eigen::Vector3d& force, const Eigen::Vector3d& moment) const = 0;

  /// Makes the last updated state the accepted one: slip is measured from it, and partners are chosen anew.
  virtual void accept() = 0;
  virtual void archive(StateArchive& archive) = 0;
};

/// Makes the partner of a face from its quadrature, which outlives it.
template <int Dim>
using PartnerMaker = std::function<std::unique_ptr<Partner<Dim>>(const FaceQuadrature<Dim>&)>;

}  // namespace burnish::inline contact
