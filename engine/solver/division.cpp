#include "engine/solver/division.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace burnish::inline solver {
namespace {

/// A grid with what its nodes count, each where it is met first.
struct WeighedGrid {
  const NodeGrid* grid;
  std::vector<double> weights;  ///< per place
};

/// Places of a grid between two corners.
struct Box {
  const WeighedGrid* grid;
  std::array<int, 3> begin, end;

  int side(std::size_t direction) const { return end[direction] - begin[direction]; }
  std::size_t longestSide() const {
    std::size_t longest = 0;
    for (std::size_t d = 1; d < 3; ++d)
      if (side(d) > side(longest)) longest = d;
    return longest;
  }

  /// Calls f(place, index) for all places.
  template <class F>
  void forEachPlace(const F& f) const {
    const auto& size = grid->grid->size;
    std::array<int, 3> index{};
    for (index[2] = begin[2]; index[2] < end[2]; ++index[2])
      for (index[1] = begin[1]; index[1] < end[1]; ++index[1])
        for (index[0] = begin[0]; index[0] < end[0]; ++index[0])
          f(static_cast<std::size_t>(index[0] + size[0] * (index[1] + size[1] * index[2])), index);
  }

  /// Weights of the layers across a direction.
  std::vector<double> layers(std::size_t direction) const {
    std::vector<double> sums(static_cast<std::size_t>(side(direction)), 0.0);
    forEachPlace([&](std::size_t place, const std::array<int, 3>& index) {
      sums[static_cast<std::size_t>(index[direction] - begin[direction])] += grid->weights[place];
    });
    return sums;
  }

  double weight() const {
    double sum = 0.0;
    forEachPlace([&](std::size_t place, const auto&) { sum += grid->weights[place]; });
    return sum;
  }
};

/// How many layers, from the front, have about the weight that is wanted: between `fewest` and `most`.
int layersWith(const std::vector<double>& layers, double wanted, int fewest, int most) {
  int best = fewest;
  double sum = 0.0, nearest = std::numeric_limits<double>::infinity();
  for (int count = 0; count <= most; ++count) {
    if (const double apart = std::abs(sum - wanted); count >= fewest && apart < nearest) {
      best = count;
      nearest = apart;
    }
    if (count < most) sum += layers[static_cast<std::size_t>(count)];
  }
  return best;
}

/// Takes boxes with about the wanted weight, less than that of all, from the front of a list, and cuts one for that.
std::vector<Box> takeFrom(std::vector<Box>& boxes, double wanted) {
  std::vector<Box> taken;
  auto next = boxes.begin();
  for (; next != boxes.end() && next->weight() <= wanted; ++next) {
    wanted -= next->weight();
    taken.push_back(*next);
  }
  if (next != boxes.end()) {
    // Neither part of the list is to be empty.
    const std::size_t direction = next->longestSide();
    const int side = next->side(direction), fewest = taken.empty() ? 1 : 0,
              most = std::max(fewest, next + 1 == boxes.end() ? side - 1 : side);
    Box part = *next;
    part.end[direction] = next->begin[direction] =
        next->begin[direction] + layersWith(next->layers(direction), wanted, fewest, most);
    taken.push_back(part);
  }
  boxes.erase(boxes.begin(), next);
  return taken;
}

/// Hands nodes in boxes that no rank has yet to so many ranks from `rank` on.
void assign(std::vector<Box> boxes, int rank, int ranks, std::vector<int>& ownerOfNode) {
  if (ranks == 1) {
    for (const Box& box : boxes)
      box.forEachPlace([&](std::size_t place, const auto&) {
        int& owner = ownerOfNode[static_cast<std::size_t>(box.grid->grid->nodes[place])];
        if (owner < 0) owner = rank;
      });
    return;
  }
  double weight = 0.0;
  for (const Box& box : boxes) weight += box.weight();
  const int half = ranks / 2;
  const std::vector<Box> first = takeFrom(boxes, weight * half / ranks);
  assign(first, rank, half, ownerOfNode);
  assign(std::move(boxes), rank + half, ranks - half, ownerOfNode);
}

}  // namespace

Division::Division(std::vector<int> itsOwners, int itsRank, int ranks)
    : owners(std::move(itsOwners)), order(owners.size()), begins{0}, rank(itsRank) {
  std::vector<int> counts(static_cast<std::size_t>(ranks), 0);
  for (const int owner : owners) ++counts[static_cast<std::size_t>(owner)];
  for (const int count : counts) begins.push_back(begins.back() + count);
  std::vector<int> next = begins;
  for (std::size_t unknown = 0; unknown < owners.size(); ++unknown)
    order[static_cast<std::size_t>(next[static_cast<std::size_t>(owners[unknown])]++)] =
        static_cast<int>(unknown);
}

Division undivided(int numUnknowns) {
  return {std::vector<int>(static_cast<std::size_t>(numUnknowns), 0), 0, 1};
}

Division divideUnknowns(const std::vector<CouplingGroups>& terms, const std::vector<bool>& prescribed,
                        int numLeading, const std::vector<NodeGrid>& grids, int rank, int ranks) {
  if (ranks == 1) return undivided(static_cast<int>(prescribed.size()));
  const CouplingCounts couplings(terms, prescribed, numLeading);
  std::vector<int> ownerOfNode(prescribed.size(), -1);
  std::vector<bool> isCounted(prescribed.size(), false);  // per node
  std::vector<WeighedGrid> weighed;
  std::vector<Box> boxes;
  for (const NodeGrid& grid : grids) {
    std::vector<double> weights;
    for (const int node : grid.nodes) {
      long count = 0;
      if (!isCounted[static_cast<std::size_t>(node)])
        for (int unknown = grid.width * node; unknown < grid.width * (node + 1); ++unknown)
          if (unknown < couplings.size()) count += couplings.of(unknown);
      isCounted[static_cast<std::size_t>(node)] = true;
      weights.push_back(static_cast<double>(count));
    }
    weighed.push_back({&grid, std::move(weights)});
  }
  for (const WeighedGrid& grid : weighed) boxes.push_back({&grid, {0, 0, 0}, grid.grid->size});
  assign(std::move(boxes), 0, ranks, ownerOfNode);

  std::vector<int> owners(prescribed.size(), ranks - 1);
  for (const NodeGrid& grid : grids)
    for (const int node : grid.nodes)
      for (int k = 0; k < grid.width; ++k)
        owners[static_cast<std::size_t>(grid.width * node + k)] = ownerOfNode[static_cast<std::size_t>(node)];
  return {std::move(owners), rank, ranks};
}

}  // namespace burnish::inline solver
