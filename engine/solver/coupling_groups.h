#pragma once
#include <vector>

namespace burnish {

/// Groups of unknowns; every pair of unknowns inside a group may be coupled.
using CouplingGroups = std::vector<std::vector<int>>;

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
  using Groups = std::vector<const std::vector<int>*>;

  std::vector<Groups> groupsOf_;
  std::vector<long> counts_;
};

}  // namespace burnish
