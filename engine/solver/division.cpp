#include "engine/solver/division.h"

namespace burnish {

Division divideUnknowns(const std::vector<CouplingGroups>& terms, const std::vector<bool>& prescribed,
                        int numLeading, int rank, int ranks) {
  Division division{{0}, rank};
  if (ranks > 1) {
    const CouplingCounts couplings(terms, prescribed, numLeading);
    std::vector<long> sums{0};  // of couplings of the unknowns before
    for (int unknown = 0; unknown < couplings.size(); ++unknown)
      sums.push_back(sums.back() + couplings.of(unknown));
    for (int r = 1; r < ranks; ++r) {
      const double share = static_cast<double>(sums.back()) * r / ranks;
      auto begin = static_cast<int>(std::lower_bound(sums.begin(), sums.end(), share) - sums.begin());
      while (begin < couplings.size() && couplings.continues(begin)) --begin;
      division.begins.push_back(std::max(begin, division.begins.back()));
    }
  }
  division.begins.push_back(static_cast<int>(prescribed.size()));
  return division;
}

}  // namespace burnish
