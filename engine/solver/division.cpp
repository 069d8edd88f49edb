#include "engine/solver/division.h"

#include <cstddef>

namespace burnish {
namespace {

using Groups = std::vector<const std::vector<int>*>;

/// How many free unknowns are in any of the groups.
class Counter {
 public:
  explicit Counter(const std::vector<bool>& prescribed)
      : prescribed_(prescribed), seen_(prescribed.size(), -1) {}

  long countIn(const Groups& groups) {
    ++round_;
    long count = 0;
    for (const auto* group : groups)
      for (const int unknown : *group) {
        int& seen = seen_[static_cast<std::size_t>(unknown)];
        if (seen != round_ && !prescribed_[static_cast<std::size_t>(unknown)]) ++count;
        seen = round_;
      }
    return count;
  }

 private:
  const std::vector<bool>& prescribed_;
  std::vector<int> seen_;  ///< round in which each unknown was met last
  int round_ = -1;
};

}  // namespace

Division divideUnknowns(const std::vector<CouplingGroups>& terms, const std::vector<bool>& prescribed,
                        int numLeading, int rank, int ranks) {
  const int numUnknowns = static_cast<int>(prescribed.size());
  const auto last = static_cast<std::size_t>(std::min(numLeading, numUnknowns));
  Division division{{0}, rank};
  if (ranks > 1) {
    std::vector<Groups> groupsOf(last);
    for (const CouplingGroups& groups : terms)
      for (const auto& group : groups)
        for (const int unknown : group)
          if (static_cast<std::size_t>(unknown) < last)
            groupsOf[static_cast<std::size_t>(unknown)].push_back(&group);
    Counter counter(prescribed);
    std::vector<long> sums{0};  // of couplings of the unknowns before
    long couplings = 0;
    for (std::size_t c = 0; c < last; ++c) {
      if (c == 0 || groupsOf[c] != groupsOf[c - 1]) couplings = counter.countIn(groupsOf[c]);
      sums.push_back(sums.back() + (prescribed[c] ? 0 : couplings));
    }
    for (int r = 1; r < ranks; ++r) {
      auto c = static_cast<std::size_t>(
          std::lower_bound(sums.begin(), sums.end(), static_cast<double>(sums.back()) * r / ranks) -
          sums.begin());
      while (c > 0 && c < last && groupsOf[c] == groupsOf[c - 1]) --c;
      division.begins.push_back(std::max(static_cast<int>(c), division.begins.back()));
    }
  }
  division.begins.push_back(numUnknowns);
  return division;
}

}  // namespace burnish
