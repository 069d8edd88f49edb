#include "engine/analysis/softening.h"

#include <fmt/format.h>

#include <cmath>
#include <variant>

namespace burnish::inline analysis {
namespace {

constexpr double kLargestStrain = 3.0;    ///< up to which a law is looked at
constexpr double kStressRounding = 1e-9;  ///< of a yield stress, relative

/// stressAt: the yield stress at a plastic strain.
template <class YieldStress>
std::vector<InputProblem> warningsOf(const YieldStress& stressAt) {
  constexpr int kSamples = 3000;
  double highest = stressAt(0.0), highestAt = 0.0;
  double fall = kStressRounding, from = 0.0,
         to = 0.0;  // the largest one, as a share of the yield stress before
  for (int k = 1; k <= kSamples; ++k) {
    const double ep = kLargestStrain * k / kSamples, stress = stressAt(ep);
    if (!(stress > 0.0))
      return {{"material.hardening",
               fmt::format(
                   "the yield stress is {:.4g} at the plastic strain ep = {:.4g}, from {:.4g} at ep = "
                   "{:.4g}: there is no answer where the body flows so far; give a law that stays above 0",
                   stress, ep, highest, highestAt)}};
    if (stress >= highest) {
      highest = stress;
      highestAt = ep;
    } else if (1.0 - stress / highest > fall) {
      fall = 1.0 - stress / highest;
      from = highestAt;
      to = ep;
    }
  }
  if (to == 0.0) return {};
  return {{"material.hardening",
           fmt::format("the body softens: its yield stress falls from {:.4g} at the plastic strain ep = "
                       "{:.4g} to {:.4g} at ep = {:.4g}; there plastic flow gathers in a band as wide as a "
                       "knot span, so that answers depend on the mesh and the run may stop",
                       stressAt(from), from, stressAt(to), to)}};
}

}  // namespace

std::vector<InputProblem> softeningWarnings(const Material& material) {
  return std::visit(
      []<class Law>(const Law& law) -> std::vector<InputProblem> {
        if constexpr (Flows<Law>) return warningsOf([&](double ep) { return law.yieldStress(ep); });
        return {};
      },
      material);
}

}  // namespace burnish::inline analysis
