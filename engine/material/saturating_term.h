#pragma once
#include <cmath>

namespace burnish::inline material {

/// A stress that grows from 0 to q: q (1 − exp(−β e)), β >= 0.
struct SaturatingTerm {
  double q = 0.0;
  double beta = 0.0;

  double sigma_y(double e) const { return q * (1.0 - std::exp(-beta * e)); }
  double slope(double e) const { return q * beta * std::exp(-beta * e); }
  double work(double e) const { return beta == 0.0 ? 0.0 : q * (e + std::expm1(-beta * e) / beta); }
};

}  // namespace burnish::inline material
