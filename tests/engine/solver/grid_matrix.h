#pragma once
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <cstdlib>
#include <random>
#include <vector>

#include "engine/solver/row_groups.h"

namespace burnish::grid {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

inline SparseRows rowsOf(const Matrix& A) {
  return {static_cast<int>(A.rows()), A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr()};
}

/// A symmetric matrix over nodes of a grid, coupled with all neighbours, some of which have lost one or two of their three
/// rows to supports. Positive definite for a `diagonal` that is large enough.
inline Matrix matrix(int nodesX, int nodesY, double diagonal) {
  const auto numRows = [](int x, int y) { return x == 0 ? 1 : (x + y) % 5 == 0 ? 2 : 3; };
  std::vector<std::vector<int>> rows;  // per node
  int next = 0;
  for (int y = 0; y < nodesY; ++y)
    for (int x = 0; x < nodesX; ++x) {
      auto& own = rows.emplace_back();
      for (int k = 0; k < numRows(x, y); ++k) own.push_back(next++);
    }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<Eigen::Triplet<double>> entries;
  for (int a = 0; a < nodesX * nodesY; ++a)
    for (int b = 0; b < nodesX * nodesY; ++b) {
      if (std::abs(a % nodesX - b % nodesX) > 1 || std::abs(a / nodesX - b / nodesX) > 1) continue;
      for (const int i : rows[static_cast<std::size_t>(a)])
        for (const int j : rows[static_cast<std::size_t>(b)]) {
          if (i > j) continue;
          const double value = number(random) + (i == j ? diagonal : 0.0);
          entries.emplace_back(i, j, value);
          if (i < j) entries.emplace_back(j, i, value);
        }
    }
  Matrix A(next, next);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

inline Eigen::VectorXd someVector(Eigen::Index size) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  return Eigen::VectorXd::NullaryExpr(size, [&] { return number(random); });
}

}  // namespace burnish::grid
