#include "engine/solver/cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace burnish {
namespace {

using Matrix = Cholesky::Matrix;

/// The upper triangle of a positive definite matrix on a grid whose points are coupled with all that are at
/// most `reach` away in both directions, numbered at random.
Matrix gridMatrix(int columns, int rows, int reach) {
  std::vector<int> number(static_cast<std::size_t>(columns * rows));
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), std::mt19937(5));
  const auto at = [&](int i, int j) { return number[static_cast<std::size_t>(i * rows + j)]; };
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      for (int k = std::max(0, i - reach); k <= std::min(columns - 1, i + reach); ++k)
        for (int l = std::max(0, j - reach); l <= std::min(rows - 1, j + reach); ++l)
          if (at(i, j) <= at(k, l))
            entries.emplace_back(at(i, j), at(k, l),
                                 at(i, j) == at(k, l) ? 40.0 : -std::cos(i + 2.0 * j + k * l));
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

double bandOperations(int unknowns, int width) {
  return static_cast<double>(unknowns) * width * width;
}

TEST(Cholesky, TakesABandWhereItIsNarrow) {
  const Matrix K = gridMatrix(40, 12, 2);
  const auto factors = makeCholesky(K);
  ASSERT_TRUE(factors->factorise(K));
  EXPECT_LT(residual(*factors, K), 1e-14);
  const double width = factors->nonZeros() / 480.0 - 1.0;
  EXPECT_EQ(factors->operations(), bandOperations(480, static_cast<int>(width)));
  EXPECT_LE(width, 1.2 * 26);  // line by line it is 26
}

TEST(Cholesky, TakesSupernodesWhereABandWouldBeWide) {
  const Matrix K = gridMatrix(60, 60, 1);
  const auto factors = makeCholesky(K);
  ASSERT_TRUE(factors->factorise(K));
  EXPECT_LT(residual(*factors, K), 1e-14);
  EXPECT_LT(factors->operations(), bandOperations(3600, 59));
}

/// Parts that nothing couples are ordered one after the other.
TEST(Cholesky, OrdersPartsOfTheirOwn) {
  Matrix K(7, 7);
  for (int i = 0; i < 7; ++i) K.insert(i, i) = 2.0;
  K.insert(0, 4) = 1.0;
  K.insert(2, 6) = -1.0;
  K.makeCompressed();
  const auto factors = makeCholesky(K);
  ASSERT_TRUE(factors->factorise(K));
  EXPECT_LT(residual(*factors, K), 1e-15);
  EXPECT_LE(factors->nonZeros(), 14.0);
}

TEST(Cholesky, SaysWhereAMatrixIsNotDefinite) {
  for (const auto& [columns, rows] : {std::pair{40, 12}, std::pair{60, 60}}) {
    Matrix K = gridMatrix(columns, rows, 1);
    const auto factors = makeCholesky(K);
    ASSERT_TRUE(factors->factorise(K));
    K.coeffRef(17, 17) = -1.0;
    EXPECT_FALSE(factors->factorise(K));
  }
}

}  // namespace
}  // namespace burnish
