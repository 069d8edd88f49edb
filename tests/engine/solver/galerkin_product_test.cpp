#include "engine/solver/galerkin_product.h"

#include <gtest/gtest.h>

#include "engine/solver/compact_matrix.h"
#include "tests/engine/solver/grid_matrix.h"

namespace burnish {
namespace {

TEST(RowGroups, AreNodesAndProductsThoseOfTheMatrix) {
  const grid::Matrix A = grid::matrix(6, 5, 10.0);
  const RowGroups groups(grid::rowsOf(A));
  EXPECT_EQ(groups.size(), 30);
  EXPECT_EQ(groups.numRows(), A.rows());
  EXPECT_EQ(groups.count(0), 1);
  EXPECT_EQ(groups.count(1), 3);
  EXPECT_EQ(groups.runs(0).size(), 2);  // nodes 0 and 1, 6 and 7
  grid::Matrix unsymmetric = A;
  unsymmetric.coeffs() = grid::someVector(A.nonZeros());
  const Eigen::VectorXd x = grid::someVector(A.rows());
  Eigen::VectorXd y(A.rows());
  groups.multiply(grid::rowsOf(unsymmetric), x.data(), y.data());
  EXPECT_LT((y - unsymmetric * x).norm(), 1e-14 * y.norm());
  groups.multiplyTransposed(grid::rowsOf(unsymmetric), x.data(), y.data());
  EXPECT_LT((y - unsymmetric.transpose() * x).norm(), 1e-14 * y.norm());
}

TEST(CompactMatrix, MultipliesByNumbersInSinglePrecisionExactly) {
  const grid::Matrix A = grid::matrix(6, 5, 10.0);
  grid::Matrix rounded = A;
  rounded.coeffs() = A.coeffs().cast<float>().cast<double>();
  const RowGroups groups(grid::rowsOf(A));
  CompactMatrix compact(groups);
  compact.assign(grid::rowsOf(A));
  const Eigen::VectorXd x = grid::someVector(A.rows());
  Eigen::VectorXd y(A.rows());
  compact.multiply(x.data(), y.data());
  EXPECT_LT((y - rounded * x).norm(), 1e-14 * y.norm());
  EXPECT_GT((y - A * x).norm(), 1e-9 * y.norm());
}

/// Each row has a half of two neighbouring columns of three per three nodes, as far as there are rows; the last row has none.
grid::Matrix prolongation(Eigen::Index numRows) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index row = 0; row + 1 < numRows; ++row)
    for (const Eigen::Index node : {row / 9, row / 9 + 1})
      entries.emplace_back(row, 3 * node + row % 3, 0.5 + 0.01 * static_cast<double>(row));
  grid::Matrix P(numRows, 3 * ((numRows - 2) / 9 + 2));
  P.setFromTriplets(entries.begin(), entries.end());
  return P;
}

TEST(GalerkinProduct, IsTheProduct) {
  grid::Matrix A = grid::matrix(6, 5, 10.0);
  const grid::Matrix P = prolongation(A.rows());
  const RowGroups groups(grid::rowsOf(A));
  GalerkinProduct product(groups, P);
  for (int time = 0; time < 2; ++time) {
    A.coeffs() = (1.0 + time) * grid::someVector(A.nonZeros());  // values are not symmetric
    product.assign(grid::rowsOf(A));
    const SparseRows rows = product.rows();
    const Eigen::Map<const grid::Matrix> found(rows.size, rows.size, rows.begins[rows.size], rows.begins,
                                               rows.columns, rows.values);
    const grid::Matrix expected = P.transpose() * A * P;
    EXPECT_LT((found - expected).norm(), 1e-14 * expected.norm());
  }
}

TEST(GalerkinProduct, HasASymmetricPatternWithNothingButWhatIsCoupled) {
  const grid::Matrix A = grid::matrix(6, 5, 10.0).cwiseAbs();
  const grid::Matrix P = prolongation(A.rows());
  const RowGroups groups(grid::rowsOf(A));
  const GalerkinProduct product(groups, P);
  const SparseRows rows = product.rows();
  const grid::Matrix coupled = P.transpose() * A * P;
  EXPECT_EQ(rows.begins[rows.size], coupled.nonZeros());
  for (int row = 0; row < rows.size; ++row)
    for (int k = rows.begins[row]; k < rows.begins[row + 1]; ++k)
      EXPECT_GT(coupled.coeff(rows.columns[k], row), 0.0);
}

/// What ranks have of a product adds up to it. The second one has the middle third of the rows; columns that it does not have come
/// behind its own.
TEST(GalerkinProduct, OfRanksAddsUpToTheProduct) {
  grid::Matrix A = grid::matrix(6, 5, 10.0);
  A.coeffs() = grid::someVector(A.nonZeros());
  const grid::Matrix P = prolongation(A.rows());
  grid::Matrix sum(P.cols(), P.cols());
  for (int rank = 0; rank < 3; ++rank) {
    const Eigen::Index n = A.rows() / 3, first = rank * n, count = rank < 2 ? n : A.rows() - 2 * n;
    const grid::Matrix rows = A.middleRows(first, count), own = rows.middleCols(first, count);
    grid::Matrix elsewhere = rows, of = P;
    elsewhere.prune(
        [&](Eigen::Index, Eigen::Index column, double) { return column < first || column >= first + count; });
    const grid::Matrix ofOwn = P.middleRows(first, count);
    const RowGroups groups(grid::rowsOf(own));
    GalerkinProduct product(groups, ofOwn, grid::rowsOf(elsewhere), of);
    product.assign(grid::rowsOf(own), grid::rowsOf(elsewhere));
    const SparseRows found = product.rows();
    sum += Eigen::Map<const grid::Matrix>(found.size, found.size, found.begins[found.size], found.begins,
                                          found.columns, found.values);
  }
  const grid::Matrix expected = P.transpose() * A * P;
  EXPECT_LT((sum - expected).norm(), 1e-14 * expected.norm());
}

}  // namespace
}  // namespace burnish
