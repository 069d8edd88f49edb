#include "engine/solver/division.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <numeric>

namespace burnish {
namespace {

/// A grid of n x m x l nodes, numbered from `first` on.
NodeGrid gridOf(std::array<int, 3> size, int first = 0) {
  NodeGrid grid{size, std::vector<int>(static_cast<std::size_t>(size[0] * size[1] * size[2]))};
  std::iota(grid.nodes.begin(), grid.nodes.end(), first);
  return grid;
}

/// Groups of the eight nodes of each cell of a grid.
CouplingGroups cellsOf(const NodeGrid& grid) {
  const auto [n, m, l] = grid.size;
  CouplingGroups groups;
  for (int k = 0; k + 1 < l; ++k)
    for (int j = 0; j + 1 < m; ++j)
      for (int i = 0; i + 1 < n; ++i) {
        auto& group = groups.emplace_back();
        for (const int corner : {0, 1, n, n + 1, n * m, n * m + 1, n * m + n, n * m + n + 1})
          for (int d = 0; d < 3; ++d)
            group.push_back(3 * grid.nodes[static_cast<std::size_t>(i + n * (j + m * k) + corner)] + d);
      }
  return groups;
}

Division divided(const std::vector<NodeGrid>& grids, int numUnknowns, int ranks) {
  std::vector<CouplingGroups> terms;
  for (const NodeGrid& grid : grids) terms.push_back(cellsOf(grid));
  return divideUnknowns(terms, std::vector<bool>(static_cast<std::size_t>(numUnknowns), false), numUnknowns,
                        grids, 0, ranks);
}

/// How many nodes of a grid each rank has, and how many are in the smallest box that holds them.
std::vector<std::pair<int, int>> nodesAndBoxes(const NodeGrid& grid, const Division& division, int ranks) {
  std::vector<std::pair<int, int>> found;
  for (int rank = 0; rank < ranks; ++rank) {
    int count = 0;
    std::array<int, 3> low = grid.size, high{-1, -1, -1};
    for (int place = 0; place < std::ssize(grid.nodes); ++place) {
      if (division.ownerOf(3 * grid.nodes[static_cast<std::size_t>(place)]) != rank) continue;
      ++count;
      const std::array index{place % grid.size[0], place / grid.size[0] % grid.size[1],
                             place / (grid.size[0] * grid.size[1])};
      for (std::size_t d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], index[d]);
        high[d] = std::max(high[d], index[d]);
      }
    }
    int box = 1;
    for (std::size_t d = 0; d < 3; ++d) box *= high[d] - low[d] + 1;
    found.emplace_back(count, box);
  }
  return found;
}

TEST(Division, OfAGridIsIntoBlocks) {
  const NodeGrid cube = gridOf({8, 8, 8});
  for (const auto& [nodes, box] : nodesAndBoxes(cube, divided({cube}, 3 * 512, 8), 8)) {
    EXPECT_EQ(nodes, 64);
    EXPECT_EQ(box, 64);
  }
  const NodeGrid beam = gridOf({3, 20, 4});
  for (const int ranks : {3, 5}) {
    const double share = 240.0 / ranks;
    for (const auto& [nodes, box] : nodesAndBoxes(beam, divided({beam}, 720, ranks), ranks)) {
      EXPECT_EQ(nodes, box);
      EXPECT_NEAR(nodes, share, 12.0) << "a layer of twelve nodes";
    }
  }
}

TEST(Division, CountsFreeUnknowns) {
  const NodeGrid beam = gridOf({2, 2, 20});
  std::vector<bool> prescribed(240, false);
  std::fill(prescribed.begin() + 120, prescribed.end(), true);
  const Division division = divideUnknowns({cellsOf(beam)}, prescribed, 240, {beam}, 0, 2);
  EXPECT_EQ(division.begins, (std::vector<int>{0, 60, 240}));
}

// As where the last face is moved. Memory that is read without having been set is full of rubbish here.
TEST(Division, CountsNothingBehindTheLeadingUnknowns) {
  const NodeGrid beam = gridOf({2, 2, 20});
  std::vector<bool> prescribed(240, false);
  std::fill(prescribed.begin() + 228, prescribed.end(), true);
  const auto beginsWith = [&](int numLeading) {
    return divideUnknowns({cellsOf(beam)}, prescribed, numLeading, {beam}, 0, 2).begins;
  };
  const std::vector<int> expected = beginsWith(240);
  ASSERT_EQ(mallopt(M_PERTURB, 0x3f), 1);
  EXPECT_EQ(beginsWith(228), expected);
  mallopt(M_PERTURB, 0);
}

// The second grid begins with the last layer of the first one; unknowns 3 * 60 and those behind are of no node.
TEST(Division, OfGridsThatMeetHasEveryNodeOnce) {
  const NodeGrid one = gridOf({2, 2, 8}), other = gridOf({2, 2, 8}, 28);
  const Division division = divided({one, other}, 3 * 60 + 2, 4);
  EXPECT_EQ(division.begins, (std::vector<int>{0, 48, 84, 132, 182}));
  EXPECT_THAT(division.order, testing::UnorderedElementsAreArray([] {
                std::vector<int> all(182);
                std::iota(all.begin(), all.end(), 0);
                return all;
              }()));
  for (int rank = 0; rank < 4; ++rank) {
    const Division ofRank(division.owners, rank, 4);
    EXPECT_TRUE(std::ranges::is_sorted(ofRank.own()));
    EXPECT_TRUE(std::ranges::all_of(ofRank.own(), [&](int unknown) { return ofRank.isOwn(unknown); }));
  }
  EXPECT_EQ(division.ownerOf(181), 3);
}

TEST(Division, OfMoreRanksThanNodesLeavesSomeWithout) {
  const NodeGrid grid = gridOf({2, 1, 1});
  EXPECT_EQ(divided({grid}, 6, 4).begins.size(), 5u);
}

}  // namespace
}  // namespace burnish
