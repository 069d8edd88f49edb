#include "engine/solver/coupling_groups.h"

#include <algorithm>
#include <cstddef>

namespace burnish::inline solver {

void addGroupsOfEach(const CouplingGroups& groups, std::vector<GroupsOfUnknown>& lists) {
  for (const auto& group : groups)
    for (const int unknown : group)
      if (static_cast<std::size_t>(unknown) < lists.size())
        lists[static_cast<std::size_t>(unknown)].push_back(&group);
}

CouplingCounts::CouplingCounts(const std::vector<CouplingGroups>& terms, const std::vector<bool>& prescribed,
                               int numLeading) {
  const auto size = std::min(static_cast<std::size_t>(numLeading), prescribed.size());
  groupsOf_.resize(size);
  for (const CouplingGroups& groups : terms) addGroupsOfEach(groups, groupsOf_);

  std::vector<std::size_t> metLast(prescribed.size(), size);  // by which unknown
  long count = 0;
  for (std::size_t unknown = 0; unknown < size; ++unknown) {
    if (!continues(static_cast<int>(unknown))) {
      count = 0;
      for (const auto* group : groupsOf_[unknown])
        for (const int other : *group) {
          const auto number = static_cast<std::size_t>(other);
          if (metLast[number] != unknown && !prescribed[number]) ++count;
          metLast[number] = unknown;
        }
    }
    counts_.push_back(prescribed[unknown] ? 0 : count);
  }
}

bool CouplingCounts::continues(int unknown) const {
  const auto number = static_cast<std::size_t>(unknown);
  return unknown > 0 && groupsOf_[number] == groupsOf_[number - 1];
}

}  // namespace burnish::inline solver
