#include "engine/solver/factor_size.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "engine/solver/cholesky.h"

namespace burnish::inline solver {
namespace {

/// The upper triangle, of ones.
Eigen::SparseMatrix<double> patternOf(const CouplingGroups& groups, int size) {
  std::vector<GroupsOfUnknown> groupsOf(static_cast<std::size_t>(size));
  addGroupsOfEach(groups, groupsOf);
  Eigen::SparseMatrix<double> pattern(size, size);
  std::vector<int> rows, metLast(static_cast<std::size_t>(size), -1);
  for (int column = 0; column < size; ++column) {
    rows = {column};
    metLast[static_cast<std::size_t>(column)] = column;
    for (const auto* group : groupsOf[static_cast<std::size_t>(column)])
      for (const int row : *group)
        if (row < column && std::exchange(metLast[static_cast<std::size_t>(row)], column) != column)
          rows.push_back(row);
    std::sort(rows.begin(), rows.end());
    pattern.startVec(column);
    for (const int row : rows) pattern.insertBack(row, column) = 1.0;
  }
  pattern.finalize();
  return pattern;
}

}  // namespace

FactorSize factorSize(const CouplingGroups& groups, int size, int blockSize) {
  if (size == 0) return {};
  const Cholesky analysis(patternOf(groups, size));
  const double rows = blockSize;
  return {rows * rows * analysis.nonZeros(), rows * rows * rows * analysis.operations()};
}

}  // namespace burnish::inline solver
