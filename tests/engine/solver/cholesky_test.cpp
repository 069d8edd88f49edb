#include "engine/solver/cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace burnish {
namespace {

using Matrix = Cholesky::Matrix;

/// The upper triangle of a positive definite matrix on a grid whose points are coupled with all that are at
/// most `reach` away in both directions, numbered along the first one or at random.
Matrix gridMatrix(int columns, int rows, int reach, bool atRandom = true) {
  std::vector<int> number(static_cast<std::size_t>(columns * rows));
  std::iota(number.begin(), number.end(), 0);
  if (atRandom) std::shuffle(number.begin(), number.end(), std::mt19937(5));
  const auto at = [&](int i, int j) { return number[static_cast<std::size_t>(i + columns * j)]; };
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      for (int k = std::max(0, i - reach); k <= std::min(columns - 1, i + reach); ++k)
        for (int l = std::max(0, j - reach); l <= std::min(rows - 1, j + reach); ++l)
          if (at(i, j) <= at(k, l))
            entries.emplace_back(
                at(i, j), at(k, l),
                at(i, j) == at(k, l) ? std::pow(2 * reach + 1, 2) : -std::cos(i + 2.0 * j + k * l));
  Matrix K(columns * rows, columns * rows);
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

/// ‖K x − b‖ / ‖b‖ of the solution for a right-hand side that begins with zeros.
double residual(Cholesky& factors, const Matrix& K) {
  Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(K.cols(), -1.0, 2.0);
  b.head(K.cols() / 3).setZero();
  const Eigen::VectorXd x = factors.backward(factors.forward(b));
  return (K.selfadjointView<Eigen::Upper>() * x - b).norm() / b.norm();
}

/// Narrow and wide grids, and couplings far and near: line by line, and in the order of CHOLMOD.
TEST(Cholesky, SolvesSystems) {
  for (const auto& [columns, rows, reach] : {std::array{40, 12, 2}, {60, 60, 1}, {25, 25, 12}, {7, 1, 1}}) {
    const Matrix K = gridMatrix(columns, rows, reach);
    Cholesky factors(K);
    for (int repeated = 0; repeated < 2; ++repeated) {
      ASSERT_TRUE(factors.factorise((1.0 + repeated) * K));
      EXPECT_LT(residual(factors, (1.0 + repeated) * K), 1e-14) << columns << " x " << rows;
      EXPECT_EQ(factors.forward(Eigen::MatrixXd(K.cols(), 0)).cols(), 0);
    }
  }
}

TEST(Cholesky, CountsTheOperationsOfEachEntry) {
  const Cholesky few(gridMatrix(60, 60, 1)), many(gridMatrix(40, 40, 20));
  EXPECT_LT(few.operations(), 500.0 * few.nonZeros());
  EXPECT_GT(many.operations(), 500.0 * many.nonZeros());
}

/// A band of 26 entries beside the diagonal.
TEST(Cholesky, EliminatesLineByLineInTheShorterDirection) {
  const Cholesky factors(gridMatrix(40, 12, 2, false));
  EXPECT_LT(factors.operations(), 1.1 * 480.0 * 26.0 * 26.0);
}

/// Parts that nothing couples.
TEST(Cholesky, SolvesSystemsInParts) {
  Matrix K(7, 7);
  for (int i = 0; i < 7; ++i) K.insert(i, i) = 2.0;
  K.insert(0, 4) = 1.0;
  K.insert(2, 6) = -1.0;
  K.makeCompressed();
  Cholesky factors(K);
  ASSERT_TRUE(factors.factorise(K));
  EXPECT_LT(residual(factors, K), 1e-15);
}

TEST(Cholesky, SaysWhereAMatrixIsNotDefinite) {
  for (const int reach : {1, 20}) {
    Matrix K = gridMatrix(40, 40, reach);
    Cholesky factors(K);
    ASSERT_TRUE(factors.factorise(K));
    K.coeffRef(17, 17) = -1.0;
    EXPECT_FALSE(factors.factorise(K));
    EXPECT_TRUE(factors.isAnalysed());
    K.coeffRef(17, 17) = std::pow(2 * reach + 1, 2);
    EXPECT_TRUE(factors.factorise(K));
    EXPECT_LT(residual(factors, K), 1e-14);
  }
}

}  // namespace
}  // namespace burnish
