#include "engine/analysis/unrecovered.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <variant>

namespace burnish::inline analysis {

std::vector<InputProblem> recoveryWarnings(const MaterialParameters& material) {
  return std::visit(
      [](const auto& parameters) -> std::vector<InputProblem> {
        if constexpr (requires { parameters.backStresses; }) {
          const auto& all = parameters.backStresses;
          const auto found = std::ranges::find(all, 0.0, &BackStress::recovery);
          if (found != all.end())
            return {
                {fmt::format("material.back_stresses[{}].recovery", std::distance(all.begin(), found)),
                 "a back stress that does not recover turns with the material and swings to and fro where shears "
                 "are larger than 2; give it a recovery, 3 will do"}};
        }
        return {};
      },
      material);
}

}  // namespace burnish::inline analysis
