#include "engine/results/reaction_record.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace burnish {
namespace {

constexpr double kRounding = 1e-9;  // of the largest force

}  // namespace

std::string reactionText(const ReactionRecord& reaction) {
  std::vector<std::string> components;
  for (const double f : reaction.force)
    components.push_back(fmt::format("{:.5g}", std::abs(f) > kRounding * reaction.largest ? f : 0.0));
  return fmt::format("force of the body on face {}: ({}), largest {:.5g} at t = {:.5g}", reaction.place,
                     fmt::join(components, ", "), reaction.largest, reaction.largestTime);
}

}  // namespace burnish
