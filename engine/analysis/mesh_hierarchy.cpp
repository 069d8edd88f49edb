#include "engine/analysis/mesh_hierarchy.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/solid/nested_spaces.h"

namespace burnish::inline analysis {
namespace {

/// Number of each free component among the free ones, -1 for the others.
std::vector<int> freeNumbers(const std::vector<bool>& held) {
  std::vector<int> numbers(held.size(), -1);
  int count = 0;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (!held[i]) numbers[i] = count++;
  return numbers;
}

/// A prolongation of nodes for each of their free components.
template <int Dim>
Hierarchy::Prolongation ofComponents(const Hierarchy::Prolongation& nodes, const std::vector<bool>& heldFine,
                                     const std::vector<bool>& heldCoarse) {
  const auto coarse = freeNumbers(heldCoarse);
  const auto rows = std::count(heldFine.begin(), heldFine.end(), false);
  const auto columns = std::count(heldCoarse.begin(), heldCoarse.end(), false);
  Hierarchy::Prolongation result(rows, columns);
  result.reserve(Dim * nodes.nonZeros());
  int row = 0;
  for (int node = 0; node < nodes.rows(); ++node)
    for (int d = 0; d < Dim; ++d) {
      if (heldFine[static_cast<std::size_t>(Dim * node + d)]) continue;
      result.startVec(row);
      for (Hierarchy::Prolongation::InnerIterator entry(nodes, node); entry; ++entry) {
        const int column = coarse[static_cast<std::size_t>(Dim * entry.col() + d)];
        if (column >= 0) result.insertBack(row, column) = entry.value();
      }
      ++row;
    }
  result.finalize();
  return result;
}

template <int Dim>
std::vector<NodeGrid> gridsOf(const Body<Dim>& body) {
  std::vector<NodeGrid> grids;
  for (std::size_t p = 0; p < body.patches.size(); ++p) {
    NodeGrid& grid = grids.emplace_back();
    for (int d = 0; d < Dim; ++d)
      grid.size[static_cast<std::size_t>(d)] = body.patches[p].basis().direction(d).numFunctions();
    grid.nodes = body.nodes[p];
    grid.width = Dim;
  }
  return grids;
}

}  // namespace

template <int Dim>
Hierarchy makeHierarchy(const Model<Dim>& model, const MergeRule& rule, int coarsest) {
  Hierarchy hierarchy{{}, gridsOf(model.body())};
  NestedSpaces<Dim> spaces(model.body());
  std::vector<bool> held(model.prescribed().begin(), model.prescribed().begin() + model.numDisplacements());
  while (std::count(held.begin(), held.end(), false) > coarsest && spaces.coarsen(rule)) {
    std::vector<bool> coarseHeld = spaces.held(held);
    hierarchy.prolongations.push_back(ofComponents<Dim>(spaces.prolongation(), held, coarseHeld));
    held = std::move(coarseHeld);
  }
  return hierarchy;
}

template Hierarchy makeHierarchy(const Model<2>&, const MergeRule&, int);
template Hierarchy makeHierarchy(const Model<3>&, const MergeRule&, int);

}  // namespace burnish::inline analysis
