#pragma once
#include <Eigen/Dense>
#include <algorithm>

#include "engine/contact/friction_law.h"

namespace burnish::inline contact {

/// Tangential traction of friction at a point, or of an average, and its derivatives. It points along the
/// slip of the slave and acts on the partner; D components across the normal.
template <int D>
struct FrictionTraction {
  Eigen::Vector<double, D> traction = Eigen::Vector<double, D>::Zero();           ///< τᵉ
  Eigen::Matrix<double, D, D> byTrial = Eigen::Matrix<double, D, D>::Identity();  ///< M = ∂τᵉ/∂τ̂
  Eigen::Vector<double, D> byPressure = Eigen::Vector<double, D>::Zero();  ///< c = ∂τᵉ/∂λ̂, λ̂ <= 0
  bool slips = false;
  double share = 1.0;  ///< |τᵉ|/|τ̂|
};

/// The return map of Coulomb friction: the trial traction τ̂ where |τ̂| <= b (stick), b τ̂/|τ̂| elsewhere (slip),
/// with b = μ ⟨-λ̂⟩, no more than a limit. μ infinite: no slip where there is contact.
template <int D>
FrictionTraction<D> coulombTraction(const Eigen::Vector<double, D>& trial, double lambdaHat,
                                    const FrictionBound& law) {
  FrictionTraction<D> result;
  result.traction = trial;
  const double coulomb = lambdaHat < 0.0 ? -law.mu * lambdaHat : 0.0;
  const double bound = std::min(coulomb, law.limit), size = trial.norm();
  if (size <= bound) return result;
  const Eigen::Vector<double, D> direction = trial / size;
  result.slips = true;
  result.share = bound / size;
  result.traction = bound * direction;
  result.byTrial = bound / size * (result.byTrial - direction * direction.transpose());
  if (lambdaHat < 0.0 && coulomb <= law.limit)
    result.byPressure = -(law.mu - law.muByPressure * lambdaHat) * direction;
  return result;
}

}  // namespace burnish::inline contact
