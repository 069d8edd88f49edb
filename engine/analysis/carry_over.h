#pragma once
#include <Eigen/Dense>
#include <cstddef>
#include <vector>

#include "engine/analysis/build_model.h"
#include "engine/analysis/simulation.h"
#include "engine/rezoning/remesh.h"

namespace burnish::inline analysis {

/// Carries what a simulation has reached to a new mesh of one of its bodies, which has one patch. The other
/// bodies keep all that they have, the multipliers and the friction of their faces among it.
class CarryOver {
 public:
  /// before: in the state to go on from; must outlive the object. body: number of the one on a new mesh.
  /// deformed: its patch in its current place. quadraturePoints: per span and direction, 0 for as many as the
  /// degree asks for. Throws `Error` where a point of the new mesh is too far from the body.
  CarryOver(const Simulation<2>& before, std::size_t body, const Patch<2>& deformed, const Remeshing& mesh,
            int quadraturePoints);

  /// The body on the new mesh with the history of its matter.
  const RezonedBody<2>& body() const { return body_; }

  /// Where a simulation on the new mesh begins: at the same time with tools and multipliers of now, no displacements
  /// of the body, and smaller steps. next: the model of this body, whose terms are given their histories.
  SteppingState startOf(const Model<2>& next) const;

  /// Values at the quadrature points of the new mesh, points x components, of a field on the old one with
  /// these coefficients, components x nodes.
  Eigen::MatrixXd atQuadraturePoints(const Eigen::MatrixXd& coefficients) const;

 private:
  void carryContacts(const Model<2>& next, Eigen::VectorXd& x) const;

  const Simulation<2>& before_;
  std::size_t number_;
  Patch<2> deformed_;
  Eigen::Matrix2Xd points_;   ///< old parameters of the new quadrature points
  Eigen::Matrix2Xd anchors_;  ///< old parameters of the new functions' anchors
  RezonedBody<2> body_;
};

/// Carries what functions of a face of a body of one patch have to the functions of a new mesh, in whose
/// anchors it is read. deformed: the old patch in its place; next: the new one.
class FaceCarryOver {
 public:
  FaceCarryOver(const Body<2>& body, FaceId face, const Patch<2>& deformed, const Patch<2>& next);

  /// Values of a field with these coefficients.
  Eigen::VectorXd values(const Eigen::VectorXd& coefficients) const;

  /// Tractions per new reference area: what acts on an old reference area acts on the stretched one now.
  Eigen::VectorXd tractions(const Eigen::VectorXd& coefficients) const;

  /// The same of multipliers λ̂, which only press.
  Eigen::VectorXd multipliers(const Eigen::VectorXd& lambdaHat) const {
    return tractions(lambdaHat).cwiseMin(0.0);
  }

 private:
  /// A place on the old face.
  struct Place {
    std::vector<int> functions;
    Eigen::VectorXd R;
    double stretch;  ///< of area
  };
  std::vector<Place> places_;
};

}  // namespace burnish::inline analysis
