#include "engine/solver/incomplete_factors.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "tests/engine/solver/grid_matrix.h"

namespace burnish {
namespace {

Eigen::VectorXd solve(const IncompleteFactors& factors, const Eigen::VectorXd& b) {
  Eigen::VectorXd x(b.size());
  factors.solve(b.data(), x.data());
  return x;
}

/// Solution with L Lᵀ made entry by entry, as textbooks have it: a row after the other, nothing outside of the pattern.
Eigen::VectorXd solveByTextbook(const grid::Matrix& A, const Eigen::VectorXd& b) {
  Eigen::MatrixXd L = A.toDense();
  const Eigen::MatrixXd pattern = (L.array() != 0.0).cast<double>();
  for (Eigen::Index k = 0; k < L.rows(); ++k) {
    L(k, k) = std::sqrt(L(k, k));
    L.col(k).tail(L.rows() - k - 1) /= L(k, k);
    for (Eigen::Index j = k + 1; j < L.rows(); ++j)
      for (Eigen::Index i = j; i < L.rows(); ++i)
        if (pattern(i, j) != 0.0) L(i, j) -= L(i, k) * L(j, k);
  }
  const Eigen::VectorXd y = L.triangularView<Eigen::Lower>().solve(b);
  return L.transpose().triangularView<Eigen::Upper>().solve(y);
}

TEST(IncompleteFactors, AreExactWhereNothingFillsIn) {
  const grid::Matrix A = grid::matrix(12, 1, 12.0);  // nodes in a row
  const RowGroups groups(grid::rowsOf(A));
  IncompleteFactors factors(groups);
  ASSERT_TRUE(factors.factorise(grid::rowsOf(A)));
  EXPECT_EQ(factors.shift(), 0.0);
  const Eigen::VectorXd exact = grid::someVector(A.rows());
  EXPECT_LT((solve(factors, A * exact) - exact).norm(), 1e-6 * exact.norm());
}

TEST(IncompleteFactors, AreThoseOfTextbooks) {
  const grid::Matrix A = grid::matrix(7, 6, 12.0);
  const RowGroups groups(grid::rowsOf(A));
  IncompleteFactors factors(groups);
  const Eigen::VectorXd b = grid::someVector(A.rows());
  for (int time = 0; time < 2; ++time) {  // factors of before are forgotten
    ASSERT_TRUE(factors.factorise(grid::rowsOf(A)));
    EXPECT_EQ(factors.shift(), 0.0);
    const Eigen::VectorXd expected = solveByTextbook(A, b);
    EXPECT_LT((solve(factors, b) - expected).norm(), 1e-6 * expected.norm());
    EXPECT_GT((A * expected - b).norm(), 1e-3 * b.norm());  // incomplete
  }
}

TEST(IncompleteFactors, DoNotLookBelowTheDiagonal) {
  const grid::Matrix A = grid::matrix(7, 6, 12.0);
  grid::Matrix changed = A;
  for (Eigen::Index row = 0; row < changed.rows(); ++row)
    for (grid::Matrix::InnerIterator entry(changed, row); entry && entry.col() < row; ++entry)
      entry.valueRef() *= -3.0;
  const RowGroups groups(grid::rowsOf(A));
  IncompleteFactors factors(groups), ofChanged(groups);
  ASSERT_TRUE(factors.factorise(grid::rowsOf(A)) && ofChanged.factorise(grid::rowsOf(changed)));
  const Eigen::VectorXd b = grid::someVector(A.rows());
  EXPECT_EQ(solve(factors, b), solve(ofChanged, b));
}

TEST(IncompleteFactors, ShiftAMatrixWhoseRowsSayNothingOfItsColumns) {
  grid::Matrix A = grid::matrix(7, 6, 1.0);
  for (Eigen::Index row = 0; row < A.rows(); ++row)
    for (grid::Matrix::InnerIterator entry(A, row); entry && entry.col() < row; ++entry)
      entry.valueRef() = 0.0;
  const RowGroups groups(grid::rowsOf(A));
  IncompleteFactors factors(groups);
  EXPECT_TRUE(factors.factorise(grid::rowsOf(A)));
}

TEST(IncompleteFactors, OfAnIndefiniteMatrixArePositiveDefinite) {
  const grid::Matrix A = grid::matrix(7, 6, 1.0);
  ASSERT_LT(A.toDense().selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1.0);
  const RowGroups groups(grid::rowsOf(A));
  IncompleteFactors factors(groups);
  ASSERT_TRUE(factors.factorise(grid::rowsOf(A)));
  EXPECT_GT(factors.shift(), 0.0);
  Eigen::MatrixXd inverse(A.rows(), A.rows());
  for (Eigen::Index k = 0; k < A.rows(); ++k)
    inverse.col(k) = solve(factors, Eigen::VectorXd::Unit(A.rows(), k));
  EXPECT_LT((inverse - inverse.transpose()).norm(), 1e-12 * inverse.norm());
  EXPECT_GT(inverse.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.0);
}

TEST(IncompleteFactors, OfNumbersThatAreNotFiniteThereAreNone) {
  grid::Matrix A = grid::matrix(7, 6, 12.0);
  const RowGroups groups(grid::rowsOf(A));
  IncompleteFactors factors(groups);
  A.coeffRef(20, 21) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(factors.factorise(grid::rowsOf(A)));
}

TEST(IncompleteFactors, TakeWhatRoundingLeavesOfASingularMatrixForNothing) {
  grid::Matrix A = Eigen::MatrixXd::Ones(6, 6).sparseView();  // two groups
  A.coeffRef(0, 0) = A.coeffRef(1, 1) = A.coeffRef(2, 2) = 1.0 + 1.0 / 3.0;
  const Eigen::MatrixXd behind = A.toDense().bottomLeftCorner(3, 3), above = A.toDense().topLeftCorner(3, 3);
  const Eigen::MatrixXd schur = behind * above.inverse() * behind.transpose();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) A.coeffRef(3 + i, 3 + j) = schur(i, j) + (i == j && i > 0 ? 1.0 : 0.0);
  const RowGroups groups(grid::rowsOf(A));
  IncompleteFactors factors(groups);
  ASSERT_TRUE(factors.factorise(grid::rowsOf(A)));
  EXPECT_GT(factors.shift(), 0.0);
}

TEST(IncompleteFactors, ShiftWhereLittleIsLeftOfAPivot) {
  const auto shiftOf = [](const Eigen::Matrix3d& entries) {
    const grid::Matrix A = entries.sparseView();
    const RowGroups groups(grid::rowsOf(A));
    IncompleteFactors factors(groups);
    EXPECT_TRUE(factors.factorise(grid::rowsOf(A)));
    return factors.shift();
  };
  const auto chain = [](double c) {
    return Eigen::Matrix3d{{1.0, c, 0.0}, {c, 1.0, 0.01}, {0.0, 0.01, 1.0}};
  };
  EXPECT_EQ(shiftOf(chain(0.98)), 0.0);     // 1 - c^2 = 0.0396
  EXPECT_EQ(shiftOf(chain(0.995)), 0.004);  // 0.0100, and 0.0139 with the first shift
  // Within a block nothing is left out.
  EXPECT_EQ(shiftOf(Eigen::Matrix3d{{1.0, 0.998, 0.99}, {0.998, 1.0, 0.99}, {0.99, 0.99, 1.0}}), 0.0);
}

TEST(IncompleteFactors, BeginWithTheLeastShift) {
  const grid::Matrix A = Eigen::MatrixXd::Identity(3, 3).sparseView();
  const RowGroups groups(grid::rowsOf(A));
  IncompleteFactors factors(groups);
  const Eigen::Vector3d b(1.0, 2.0, 3.0);
  int count = 0;
  for (std::optional<double> shift = 0.0; shift; shift = IncompleteFactors::nextShift(*shift), ++count) {
    ASSERT_TRUE(factors.factorise(grid::rowsOf(A), *shift));
    EXPECT_EQ(factors.shift(), *shift);
    const auto next = IncompleteFactors::nextShift(*shift);
    EXPECT_EQ(IncompleteFactors::shiftBefore(next.value_or(0.0)), next ? *shift : 0.0);
    Eigen::Vector3d x;
    factors.solve(b.data(), x.data());
    EXPECT_LT((x - b / (1.0 + *shift)).norm(), 1e-14);
  }
  EXPECT_EQ(count, 8);  // 0, 0.001 and six times four times as much
}

TEST(IncompleteFactors, SolveAgainAfterARightHandSideThatIsNotFinite) {
  const grid::Matrix A = grid::matrix(7, 6, 12.0);
  const RowGroups groups(grid::rowsOf(A));
  IncompleteFactors factors(groups);
  ASSERT_TRUE(factors.factorise(grid::rowsOf(A)));
  const Eigen::VectorXd b = grid::someVector(A.rows()), before = solve(factors, b);
  Eigen::VectorXd infinite = b;
  infinite(b.size() - 4) = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(solve(factors, infinite).allFinite());
  EXPECT_EQ(solve(factors, b), before);
}

}  // namespace
}  // namespace burnish
