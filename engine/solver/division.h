#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/solver/coupling_groups.h"

namespace burnish::inline solver {

/// Which unknowns the ranks of a team answer for. Those of a rank follow each other in the order of their numbers.
struct Division {
  std::vector<int> owners;         ///< per unknown its rank
  std::vector<int> order, begins;  ///< rank r answers for order[begins[r]] to order[begins[r + 1] - 1]
  int rank = 0;                    ///< this one

  Division() = default;
  Division(std::vector<int> owners, int rank, int ranks);

  int ranks() const { return static_cast<int>(begins.size()) - 1; }
  bool isOwn(int unknown) const { return ownerOf(unknown) == rank; }
  bool isWhole() const { return ranks() == 1; }

  /// The rank that answers for an unknown.
  int ownerOf(int unknown) const { return owners[static_cast<std::size_t>(unknown)]; }

  /// Unknowns of this rank.
  std::span<const int> own() const {
    const auto r = static_cast<std::size_t>(rank);
    return std::span(order).subspan(static_cast<std::size_t>(begins[r]),
                                    static_cast<std::size_t>(begins[r + 1] - begins[r]));
  }
};

/// Nodes at the places of a grid, the first direction fastest. Node a has the unknowns from `width` a on.
struct NodeGrid {
  std::array<int, 3> size{1, 1, 1};  ///< places in each direction
  std::vector<int> nodes;
  int width = 3;
};

/// All unknowns for a process alone.
Division undivided(int numUnknowns);

/// Divides the nodes of grids into blocks, by cutting what is left between layers, across the longest side, until
/// every rank has one: unknowns of a block have about as many couplings with free ones as those of any other, as
/// far as layers are not divided. Those of the first `numLeading` that are free count; unknowns of no node, as
/// multipliers, go to the last rank. prescribed: one flag per unknown.
Division divideUnknowns(const std::vector<CouplingGroups>& terms, const std::vector<bool>& prescribed,
                        int numLeading, const std::vector<NodeGrid>& grids, int rank, int ranks);

}  // namespace burnish::inline solver
