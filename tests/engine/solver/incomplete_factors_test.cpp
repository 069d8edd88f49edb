#include "engine/solver/incomplete_factors.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <limits>
#include <random>

#include "engine/solver/compact_matrix.h"

namespace burnish {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

SparseRows rowsOf(const Matrix& A) {
  return {static_cast<int>(A.rows()), A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr()};
}

/// A symmetric matrix over nodes of a grid, coupled with all neighbours, some of which have lost one or two of their three
/// rows to supports. Positive definite for a `diagonal` that is large enough.
Matrix gridMatrix(int nodesX, int nodesY, double diagonal) {
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

Eigen::VectorXd someVector(Eigen::Index size) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  return Eigen::VectorXd::NullaryExpr(size, [&] { return number(random); });
}

Eigen::VectorXd solve(const IncompleteFactors& factors, const Eigen::VectorXd& b) {
  Eigen::VectorXd x(b.size());
  factors.solve(b.data(), x.data());
  return x;
}

/// Solution with L Lᵀ made entry by entry, as textbooks have it: a row after the other, nothing outside of the pattern.
Eigen::VectorXd solveByTextbook(const Matrix& A, const Eigen::VectorXd& b) {
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

TEST(RowGroups, AreNodesAndProductsThoseOfTheMatrix) {
  const Matrix A = gridMatrix(6, 5, 10.0);
  const RowGroups groups(rowsOf(A));
  EXPECT_EQ(groups.size(), 30);
  EXPECT_EQ(groups.numRows(), A.rows());
  EXPECT_EQ(groups.count(0), 1);
  EXPECT_EQ(groups.count(1), 3);
  EXPECT_EQ(groups.runs(0).size(), 2);  // nodes 0 and 1, 6 and 7
  Matrix unsymmetric = A;
  unsymmetric.coeffs() = someVector(A.nonZeros());
  const Eigen::VectorXd x = someVector(A.rows());
  Eigen::VectorXd y(A.rows());
  groups.multiply(rowsOf(unsymmetric), x.data(), y.data());
  EXPECT_LT((y - unsymmetric * x).norm(), 1e-14 * y.norm());
  groups.multiplyTransposed(rowsOf(unsymmetric), x.data(), y.data());
  EXPECT_LT((y - unsymmetric.transpose() * x).norm(), 1e-14 * y.norm());
}

TEST(CompactMatrix, MultipliesByNumbersInSinglePrecisionExactly) {
  const Matrix A = gridMatrix(6, 5, 10.0);
  Matrix rounded = A;
  rounded.coeffs() = A.coeffs().cast<float>().cast<double>();
  const RowGroups groups(rowsOf(A));
  CompactMatrix compact(groups);
  compact.assign(rowsOf(A));
  const Eigen::VectorXd x = someVector(A.rows());
  Eigen::VectorXd y(A.rows());
  compact.multiply(x.data(), y.data());
  EXPECT_LT((y - rounded * x).norm(), 1e-14 * y.norm());
  EXPECT_GT((y - A * x).norm(), 1e-9 * y.norm());
}

TEST(IncompleteFactors, AreExactWhereNothingFillsIn) {
  const Matrix A = gridMatrix(12, 1, 12.0);  // nodes in a row
  const RowGroups groups(rowsOf(A));
  IncompleteFactors factors(groups);
  ASSERT_TRUE(factors.factorise(rowsOf(A)));
  EXPECT_EQ(factors.shift(), 0.0);
  const Eigen::VectorXd exact = someVector(A.rows());
  EXPECT_LT((solve(factors, A * exact) - exact).norm(), 1e-6 * exact.norm());
}

TEST(IncompleteFactors, AreThoseOfTextbooks) {
  const Matrix A = gridMatrix(7, 6, 12.0);
  const RowGroups groups(rowsOf(A));
  IncompleteFactors factors(groups);
  const Eigen::VectorXd b = someVector(A.rows());
  for (int time = 0; time < 2; ++time) {  // factors of before are forgotten
    ASSERT_TRUE(factors.factorise(rowsOf(A)));
    EXPECT_EQ(factors.shift(), 0.0);
    const Eigen::VectorXd expected = solveByTextbook(A, b);
    EXPECT_LT((solve(factors, b) - expected).norm(), 1e-6 * expected.norm());
    EXPECT_GT((A * expected - b).norm(), 1e-3 * b.norm());  // incomplete
  }
}

TEST(IncompleteFactors, DoNotLookBelowTheDiagonal) {
  const Matrix A = gridMatrix(7, 6, 12.0);
  Matrix changed = A;
  for (Eigen::Index row = 0; row < changed.rows(); ++row)
    for (Matrix::InnerIterator entry(changed, row); entry && entry.col() < row; ++entry)
      entry.valueRef() *= -3.0;
  const RowGroups groups(rowsOf(A));
  IncompleteFactors factors(groups), ofChanged(groups);
  ASSERT_TRUE(factors.factorise(rowsOf(A)) && ofChanged.factorise(rowsOf(changed)));
  const Eigen::VectorXd b = someVector(A.rows());
  EXPECT_EQ(solve(factors, b), solve(ofChanged, b));
}

TEST(IncompleteFactors, OfAnIndefiniteMatrixArePositiveDefinite) {
  const Matrix A = gridMatrix(7, 6, 1.0);
  ASSERT_LT(A.toDense().selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1.0);
  const RowGroups groups(rowsOf(A));
  IncompleteFactors factors(groups);
  ASSERT_TRUE(factors.factorise(rowsOf(A)));
  EXPECT_GT(factors.shift(), 0.0);
  Eigen::MatrixXd inverse(A.rows(), A.rows());
  for (Eigen::Index k = 0; k < A.rows(); ++k)
    inverse.col(k) = solve(factors, Eigen::VectorXd::Unit(A.rows(), k));
  EXPECT_LT((inverse - inverse.transpose()).norm(), 1e-12 * inverse.norm());
  EXPECT_GT(inverse.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.0);
}

TEST(IncompleteFactors, OfNumbersThatAreNotFiniteThereAreNone) {
  Matrix A = gridMatrix(7, 6, 12.0);
  const RowGroups groups(rowsOf(A));
  IncompleteFactors factors(groups);
  A.coeffs()(A.nonZeros() / 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(factors.factorise(rowsOf(A)));
}

}  // namespace
}  // namespace burnish
