#pragma once
#include <vector>

namespace burnish::inline solver {

/// Groups of unknowns; every pair of unknowns inside a group may be coupled.
using CouplingGroups = std::vector<std::vector<int>>;

/// The groups that one unknown is in, in their order.
using GroupsOfUnknown = std::vector<const std::vector<int>*>;

/// Appends to the list of each of the first unknowns, as many as there are lists, the groups that it is in. groups: must
/// outlive the lists.
void addGroupsOfEach(const CouplingGroups& groups, std::vector<GroupsOfUnknown>& lists);

/// With how many others the first unknowns of a tangent are coupled.
class CouplingCounts {
 public:
  /// terms: must outlive the object. prescribed: one flag per unknown; those that are count for nothing.
  /// numLeading: the first unknowns, which are counted.
  CouplingCounts(const std::vector<CouplingGroups>& terms, const std::vector<bool>& prescribed,
                 int numLeading);

  int size() const { return static_cast<int>(counts_.size()); }

  /// Free unknowns that are coupled with a free one, itself among them; 0 for one that is prescribed.
  long of(int unknown) const { return counts_[static_cast<std::size_t>(unknown)]; }

  /// Whether an unknown is in the groups of the one before it, as those of a node are.
  bool continues(int unknown) const;

 private:
  std::vector<GroupsOfUnknown> groupsOf_;
  std::vector<long> counts_;
};

}  // namespace burnish::inline solver
