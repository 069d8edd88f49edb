#include "engine/material/formula_rate.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "engine/core/formula.h"
#include "engine/schema/problems.h"

namespace burnish::inline material {
namespace {

Formula readFormula(const std::string& text) {
  return Formula({text}, {}, {"sigma_y", "ep", "rate"});
}

/// df/dx by differences of fourth order, x > 0.
template <class F>
double derivative(const F& f, double x) {
  const double h = 1e-3 * x;
  return (8.0 * (f(x + h) - f(x - h)) - (f(x + 2.0 * h) - f(x - 2.0 * h))) / (12.0 * h);
}

}  // namespace

/// As many parsers as threads evaluate at a time, as one serves one thread.
class FormulaPool {
 public:
  explicit FormulaPool(std::string text) : text_(std::move(text)) { idle_.push_back(readFormula(text_)); }

  bool dependsOn(const std::string& variable) const { return idle_.front().dependsOn(variable); }

  /// f(formula) with a parser of the caller's own.
  template <class F>
  auto with(const F& f) {
    Formula formula = take();
    const auto result = f(formula);
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(formula));
    return result;
  }

 private:
  Formula take() {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        Formula formula = std::move(idle_.back());
        idle_.pop_back();
        return formula;
      }
    }
    return readFormula(text_);
  }

  std::string text_;
  std::mutex mutex_;
  std::vector<Formula> idle_;
};

FormulaRate::FormulaRate(const Parameters& law)
    : pool_(std::make_shared<FormulaPool>(law.formula)), dependsOnStrain_(pool_->dependsOn("ep")) {}

FormulaRate::FlowStress FormulaRate::at(double sigma_y, double e_p, double rate) const {
  return pool_->with([&](const Formula& formula) -> FlowStress {
    const auto value = [&](double s, double e, double r) { return formula.at(std::array{s, e, r}); };
    try {
      return {value(sigma_y, e_p, rate), derivative([&](double s) { return value(s, e_p, rate); }, sigma_y),
              dependsOnStrain_ ? derivative([&](double e) { return value(sigma_y, e, rate); }, e_p) : 0.0,
              derivative([&](double r) { return value(sigma_y, e_p, r); }, rate)};
    } catch (const FormulaError&) {
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      return {none, none, none, none};
    }
  });
}

void check(const FormulaRate::Parameters& law, const Problems& problems, const std::string& key,
           const std::function<double(double)>& sigma_y) {
  const std::string path = key + ".formula";
  if (!problems.clean(path)) return;
  try {
    const Formula formula = readFormula(law.formula);
    for (const double e : {0.0, 0.01, 0.1, 1.0}) {
      const double yield = sigma_y(e);
      double slower = formula.at(std::array{yield, e, 0.0});
      if (std::abs(slower - yield) > 1e-9 * yield)
        return problems.report(
            path,
            fmt::format("found a flow stress of {:.6g} at a rate of 0, ep = {} and a yield stress of {:.6g}; "
                        "allowed: a formula that is the yield stress, sigma_y, there.",
                        slower, e, yield));
      for (int power = -9; power <= 9; ++power) {
        const double stress = formula.at(std::array{yield, e, std::pow(10.0, power)});
        if (stress < slower - 1e-12 * yield)
          return problems.report(
              path,
              fmt::format(
                  "found a flow stress that falls from {:.6g} to {:.6g} up to a rate of 1e{}, at ep = {}; "
                  "allowed: a formula that does not fall with the rate.",
                  slower, stress, power, e));
        slower = stress;
      }
    }
  } catch (const Error& e) {
    problems.report(path, fmt::format("{}; allowed: a formula in sigma_y, ep and rate.", e.what()));
  }
}

}  // namespace burnish::inline material
