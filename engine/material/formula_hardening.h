#pragma once
#include <memory>
#include <string>

#include "engine/material/law_list.h"
#include "engine/material/piecewise_chebyshev.h"

namespace burnish::inline schema {
class Problems;
}  // namespace burnish::inline schema

namespace burnish::inline material {

/// Yield stress from a formula in the plastic strain `ep`, such as "300*(0.01+ep)^0.2". The formula is read
/// once and replaced by an interpolant of 14 digits, which is fast, has an exact slope and integral, and may
/// be used from any number of threads; copies share it.
class FormulaHardening {
 public:
  static constexpr LawKind kind{"formula", "A formula in the equivalent plastic strain."};

  struct Parameters {
    std::string formula;  ///< yield stress as a function of `ep`
  };

  /// Throws `Error` when the formula cannot be read, or its value at ep = 0 is not positive.
  explicit FormulaHardening(const Parameters& law);

  double sigma_y(double e) const { return curve_->value(e); }
  double slope(double e) const { return curve_->slope(e); }
  double work(double e) const { return curve_->integral(e); }

 private:
  std::shared_ptr<const PiecewiseChebyshev> curve_;
};

template <class Visitor>
void describe(Visitor& v, FormulaHardening::Parameters& s) {
  v.field("formula", s.formula, {.required = true, .unit = "stress"},
          "Yield stress as a formula in ep, such as \"80 + 90 * (1 - exp(-18 * ep))\".");
}

/// See `checkHardening`.
void check(const FormulaHardening::Parameters& law, const Problems& problems, const std::string& key);

}  // namespace burnish::inline material
