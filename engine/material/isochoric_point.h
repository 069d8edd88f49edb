#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

namespace burnish::inline material {

/// A power of the isochoric principal stretches in a stress: μ λ̄^α.
struct StretchPower {
  double mu;
  double alpha;
};

/// An isochoric energy W̄ at principal stretches λ̄_A. With β_A = λ̄_A ∂W̄/∂λ̄_A,
///   β_A = Σ_p μ_p λ̄_A^α_p,   ∂β_A/∂ln λ̄_B = δ_AB Σ_p μ_p α_p λ̄_A^α_p + coupling λ̄_A² λ̄_B².
struct IsochoricPoint {
  static constexpr std::size_t kMostPowers = 6;

  double energy = 0.0;
  std::array<StretchPower, kMostPowers> terms{};
  std::size_t count = 0;  ///< of the terms
  double coupling = 0.0;

  std::span<const StretchPower> powers() const { return {terms.data(), count}; }

  void add(double mu, double alpha) { terms[count++] = {mu, alpha}; }
};

/// Σ_A λ̄_A^α − 3 at the logarithms of the stretches.
inline double powerSum(const Eigen::Array3d& logStretches, double alpha) {
  return (alpha * logStretches).expm1().sum();
}

}  // namespace burnish::inline material
