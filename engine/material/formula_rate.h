#pragma once
#include <functional>
#include <memory>
#include <string>

#include "engine/material/law_list.h"

namespace burnish::inline schema {
class Problems;
}  // namespace burnish::inline schema

namespace burnish::inline material {

class FormulaPool;

/// A flow stress σ(σ_y, e, ė) from a formula in `sigma_y`, the yield stress without rates, `ep` and `rate`. May be used
/// from any number of threads; copies share what the formula was read into.
class FormulaRate {
 public:
  static constexpr LawKind kind{"formula", "A formula of the flow stress in sigma_y, ep and rate."};

  struct Parameters {
    std::string formula;
  };

  /// The flow stress and its partial derivatives, from differences of fourth order.
  struct FlowStress {
    double value, byYieldStress, byStrain, byRate;
  };

  /// Throws `Error` when the formula cannot be read.
  explicit FormulaRate(const Parameters& law);

  /// For positive e_p and rate; not finite where the formula is not.
  FlowStress at(double sigma_y, double e_p, double rate) const;

 private:
  std::shared_ptr<FormulaPool> pool_;
  bool dependsOnStrain_;
};

template <class Visitor>
void describe(Visitor& v, FormulaRate::Parameters& s) {
  v.field("formula", s.formula, {.required = true, .unit = "stress"},
          "Flow stress as a formula in sigma_y, the yield stress of `hardening`, ep and rate, such as "
          "\"sigma_y + 150 * rate^0.2\"; sigma_y at a rate of 0, and not falling with the rate.");
}

/// Reports a formula that cannot be read, is not the yield stress at a rate of 0, or falls with the rate, at some
/// plastic strains. sigma_y: the yield stress without rates at a plastic strain.
void check(const FormulaRate::Parameters& law, const Problems& problems, const std::string& key,
           const std::function<double(double)>& sigma_y);

}  // namespace burnish::inline material
