#pragma once
#include <Eigen/Dense>
#include <vector>

namespace burnish::inline solid {

/// What the points of a body had been through when its present reference configuration was chosen, one entry
/// per quadrature point. The deformation that the law sees is F V_e: the stress-free state of a point's
/// neighbourhood is taken to the reference by its elastic stretch V_e = √b_e, plastic flow left aside.
struct ReferenceState {
  std::vector<Eigen::Matrix3d> stretch;  ///< V_e, symmetric and positive
  Eigen::MatrixXd numbers;               ///< of the law's states that went along, kinds x points

  /// Quadrature weights by stress-free volume: those of the place over det V_e.
  Eigen::VectorXd weights;

  double plasticWork = 0.0;  ///< of the whole body

  /// Deformation gradients F₀ against the reference of the place in which the points have these stretches: then the
  /// reference is another one, and the law sees F F₀^{-1} V_e. Empty: it is that place.
  std::vector<Eigen::Matrix3d> gradients{};
};

}  // namespace burnish::inline solid
