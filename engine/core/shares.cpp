#include "engine/core/shares.h"

#include <algorithm>
#include <utility>

namespace burnish::inline core {

void gatherLists(const Team& team, std::vector<double>& numbers) {
  if (team.isAlone()) return;
  std::vector<double> counts(static_cast<std::size_t>(team.size()), 0.0);
  counts[static_cast<std::size_t>(team.rank())] = static_cast<double>(numbers.size());
  team.sum(counts);
  std::vector<int> begins{0};
  for (const double count : counts) begins.push_back(begins.back() + static_cast<int>(count));
  std::vector<double> all(static_cast<std::size_t>(begins.back()));
  std::copy(numbers.begin(), numbers.end(), all.begin() + begins[static_cast<std::size_t>(team.rank())]);
  team.gather(all, begins);
  numbers = std::move(all);
}

}  // namespace burnish::inline core
