#pragma once
#include <algorithm>
#include <vector>

#include "engine/solver/coupling_groups.h"

namespace burnish {

/// Which unknowns the ranks of a team answer for: rank r for those from begins[r] to begins[r + 1].
struct Division {
  std::vector<int> begins;
  int rank = 0;  ///< this one

  int first() const { return begins[static_cast<std::size_t>(rank)]; }
  int end() const { return begins[static_cast<std::size_t>(rank) + 1]; }
  bool isOwn(int unknown) const { return unknown >= first() && unknown < end(); }
  bool isWhole() const { return begins.size() == 2; }

  /// The rank that answers for an unknown.
  int ownerOf(int unknown) const {
    return static_cast<int>(std::upper_bound(begins.begin() + 1, begins.end() - 1, unknown) -
                            begins.begin()) -
           1;
  }
};

/// Divides unknowns among ranks in such a way that each has as many couplings with free ones as any other, as
/// far as unknowns with the same groups, those of a node, stay together. Those of the first `numLeading` that
/// are free count; those behind go to the last rank. prescribed: one flag per unknown.
Division divideUnknowns(const std::vector<CouplingGroups>& terms, const std::vector<bool>& prescribed,
                        int numLeading, int rank, int ranks);

}  // namespace burnish
