#pragma once
#include <memory>
#include <string>

#include "engine/material/piecewise_chebyshev.h"

namespace burnish {

/// Yield stress from a formula in the plastic strain `ep`, such as "300*(0.01+ep)^0.2". The formula is read
/// once and replaced by an interpolant of 14 digits, which is fast, has an exact slope and integral, and may
/// be used from any number of threads; copies share it.
class FormulaHardening {
 public:
  /// Throws `Error` when the formula cannot be read, or its value at ep = 0 is not positive.
  explicit FormulaHardening(const std::string& formula);

  double sigma_y(double e) const { return curve_->value(e); }
  double slope(double e) const { return curve_->slope(e); }
  double work(double e) const { return curve_->integral(e); }

 private:
  std::shared_ptr<const PiecewiseChebyshev> curve_;
};

}  // namespace burnish
