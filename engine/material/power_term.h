#pragma once
#include <cmath>

namespace burnish::inline material {

/// A plastic strain that is added where a power of it has an infinite slope at zero. It is nothing beside the strain at
/// the yield point of any metal.
inline constexpr double kLeastPlasticStrain = 1e-8;

/// A stress that grows as a power: q (e + shift)^n, n > 0.
struct PowerTerm {
  double q = 0.0;
  double n = 1.0;
  double shift = kLeastPlasticStrain;

  double sigma_y(double e) const { return q * std::pow(e + shift, n); }
  double slope(double e) const { return q * n * std::pow(e + shift, n - 1.0); }
  double work(double e) const {
    return q / (n + 1.0) * (std::pow(e + shift, n + 1.0) - std::pow(shift, n + 1.0));
  }
};

}  // namespace burnish::inline material
