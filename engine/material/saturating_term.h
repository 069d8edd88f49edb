#pragma once
#include <cmath>

#include "engine/core/lanes.h"

namespace burnish {

/// A stress that grows from 0 to q: q (1 − exp(−β e)), β >= 0.
struct SaturatingTerm {
  double q = 0.0;
  double beta = 0.0;

  template <class Number>
  Number sigma_y(Number e) const {
    return -q * expm1(-beta * e);
  }
  template <class Number>
  Number slope(Number e) const {
    return q * beta * (1.0 + expm1(-beta * e));
  }
  double work(double e) const { return beta == 0.0 ? 0.0 : q * (e + std::expm1(-beta * e) / beta); }
};

}  // namespace burnish
