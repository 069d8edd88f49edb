#include "engine/solver/factor_size.h"

#include <gtest/gtest.h>

#include "engine/solver/coupling_groups.h"
#include "engine/solver/direct_solver.h"
#include "engine/solver/sparse_system.h"

/// What is told of a tangent by its groups alone, against the tangent.
namespace burnish {
namespace {

/// Elements of eight nodes in a block of so many of them per direction.
std::vector<std::vector<int>> elements(int perDirection) {
  const int n = perDirection + 1;
  std::vector<std::vector<int>> groups;
  for (int z = 0; z < perDirection; ++z)
    for (int y = 0; y < perDirection; ++y)
      for (int x = 0; x < perDirection; ++x) {
        std::vector<int>& group = groups.emplace_back();
        for (int k = 0; k < 8; ++k) group.push_back((z + k / 4) * n * n + (y + k / 2 % 2) * n + x + k % 2);
      }
  return groups;
}

/// Three unknowns per node.
CouplingGroups unknownsOf(const std::vector<std::vector<int>>& nodes) {
  CouplingGroups groups;
  for (const auto& group : nodes) {
    std::vector<int>& unknowns = groups.emplace_back();
    for (const int node : group)
      for (int d = 0; d < 3; ++d) unknowns.push_back(3 * node + d);
  }
  return groups;
}

/// A tangent that is positive definite, with every entry of its pattern.
SparseSystem systemOf(const CouplingGroups& groups, const std::vector<bool>& prescribed) {
  SparseSystem system(prescribed, {groups});
  system.setZero();
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const auto n = std::ssize(groups[k]);
    system.add(0, k, Eigen::MatrixXd::Identity(n, n) + Eigen::MatrixXd::Constant(n, n, 1e-3));
  }
  return system;
}

TEST(CouplingCounts, AreThoseOfTheColumnsOfTheTangent) {
  const auto groups = unknownsOf(elements(4));
  std::vector<bool> prescribed(3 * 125, false);
  for (std::size_t k = 0; k < 80; ++k) prescribed[k] = true;
  SparseSystem system = systemOf(groups, prescribed);
  const CouplingCounts counts({groups}, prescribed, 3 * 125);
  ASSERT_EQ(counts.size(), 3 * 125);
  Eigen::Index column = 0;
  for (int unknown = 0; unknown < counts.size(); ++unknown) {
    if (prescribed[static_cast<std::size_t>(unknown)]) {
      EXPECT_EQ(counts.of(unknown), 0);
      continue;
    }
    EXPECT_EQ(counts.of(unknown), system.whole().col(column++).nonZeros()) << unknown;
    EXPECT_EQ(counts.continues(unknown), unknown % 3 > 0) << unknown;
  }
}

TEST(FactorSize, OfNodesIsThatOfTheFactorsOfTheirUnknowns) {
  for (const int perDirection : {6, 12}) {
    const auto nodes = elements(perDirection);
    const int numNodes = (perDirection + 1) * (perDirection + 1) * (perDirection + 1);
    SparseSystem system =
        systemOf(unknownsOf(nodes), std::vector<bool>(static_cast<std::size_t>(3 * numNodes), false));
    DirectSolver solver(3 * numNodes);
    ASSERT_TRUE(solver.factorise(system));
    const auto factors = static_cast<double>(solver.factorNonZeros());
    // Nodes may be ordered otherwise than unknowns.
    EXPECT_NEAR(factorSize(nodes, numNodes, 3).nonZeros, factors, 0.3 * factors) << perDirection;
  }
  // A full matrix of n rows: n (n + 1) / 2 non-zeros and n³ / 3 operations, of multiplications and additions.
  const FactorSize full = factorSize({{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}, 10, 1);
  EXPECT_EQ(full.nonZeros, 55.0);
  EXPECT_NEAR(full.operations, 1000.0 / 3.0, 60.0);
  EXPECT_EQ(factorSize({}, 0, 3).nonZeros, 0.0);
}

}  // namespace
}  // namespace burnish
