// The number of unstable directions against the eigenvalues of dense matrices.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "engine/solver/inertia.h"

namespace burnish {
namespace {

/// A dense matrix as a sparse one that stores every entry.
Eigen::SparseMatrix<double> sparse(const Eigen::MatrixXd& A) {
  std::vector<Eigen::Triplet<double>> triplets;
  for (int j = 0; j < A.cols(); ++j)
    for (int i = 0; i < A.rows(); ++i) triplets.emplace_back(i, j, A(i, j));
  Eigen::SparseMatrix<double> result(A.rows(), A.cols());
  result.setFromTriplets(triplets.begin(), triplets.end());
  return result;
}

Eigen::MatrixXd randomMatrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(generator); });
}

/// A symmetric matrix with the eigenvalues given.
Eigen::MatrixXd withEigenvalues(const Eigen::VectorXd& values, unsigned seed) {
  const Eigen::MatrixXd random = randomMatrix(values.size(), values.size(), seed);
  const Eigen::MatrixXd Q = random.householderQr().householderQ();
  return Q * values.asDiagonal() * Q.transpose();
}

/// [K B; Bᵀ C] with the last multiplier at rest.
Eigen::SparseMatrix<double> saddlePoint(const Eigen::MatrixXd& K, const Eigen::MatrixXd& B) {
  const Eigen::Index n = K.rows(), m = B.cols() + 1;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + m, n + m);
  A.topLeftCorner(n, n) = K;
  A.block(0, n, n, m - 1) = B;
  A.block(n, 0, m - 1, n) = B.transpose();
  A(n + m - 1, n + m - 1) = -2.0;
  return sparse(A);
}

/// Negative eigenvalues of K on displacements that B leaves free.
int negativeOnKernel(const Eigen::MatrixXd& K, const Eigen::MatrixXd& B) {
  const Eigen::MatrixXd Q = B.householderQr().householderQ();
  const Eigen::MatrixXd Z = Q.rightCols(K.rows() - B.cols());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(Z.transpose() * K * Z);
  return static_cast<int>((solver.eigenvalues().array() < 0.0).count());
}

TEST(Inertia, CountsNegativeEigenvalues) {
  for (int negative = 0; negative <= 6; ++negative) {
    Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(12, 0.5, 3.0);
    values.head(negative) *= -1.0;
    Inertia inertia(12);
    EXPECT_EQ(inertia.unstableDirections(sparse(withEigenvalues(values, 7))), negative);
  }
}

TEST(Inertia, CountsOnWhatActiveMultipliersLeaveFree) {
  int fewer = 0;
  Inertia inertia(12);
  for (unsigned seed = 0; seed < 20; ++seed) {
    Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(12, 0.5, 3.0);
    values.head(3) *= -1.0;
    const Eigen::MatrixXd K = withEigenvalues(values, seed), B = randomMatrix(12, 4, seed + 100);
    const int expected = negativeOnKernel(K, B);
    EXPECT_EQ(inertia.unstableDirections(saddlePoint(K, B)), expected) << seed;
    fewer += expected < 3 ? 1 : 0;
  }
  EXPECT_GT(fewer, 5);  // the border decides
}

/// Multipliers that yield: their stiffness is B (-C)⁻¹ Bᵀ. By Sylvester's law A has one negative eigenvalue for
/// each of them, beside those of K with that stiffness.
TEST(Inertia, CountsWithMultipliersThatAreCoupledWithOneAnother) {
  int fewer = 0;
  Inertia inertia(12);
  for (unsigned seed = 0; seed < 20; ++seed) {
    Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(12, 0.5, 3.0);
    values.head(3) *= -1.0;
    const Eigen::MatrixXd K = withEigenvalues(values, seed), B = randomMatrix(12, 4, seed + 100),
                          C = randomMatrix(4, 4, seed + 200);
    Eigen::MatrixXd A(16, 16);
    A << K, B, B.transpose(), -C * C.transpose();
    const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues();
    const int expected = static_cast<int>((eigenvalues.array() < 0.0).count()) - 4;
    EXPECT_EQ(inertia.unstableDirections(sparse(A)), expected) << seed;
    fewer += expected < 3 ? 1 : 0;
  }
  EXPECT_GT(fewer, 5);
}

TEST(Inertia, TakesTheSymmetricPart) {
  const Eigen::MatrixXd skew = randomMatrix(8, 8, 3);
  Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(8, 1.0, 2.0);
  values(0) = -1.0;
  Inertia inertia(8);
  EXPECT_EQ(inertia.unstableDirections(sparse(withEigenvalues(values, 5) + skew - skew.transpose())), 1);
}

TEST(Inertia, AZeroPivotIsNoStableDirection) {
  Inertia inertia(3);
  EXPECT_EQ(inertia.unstableDirections(sparse(Eigen::Vector3d(1.0, 0.0, 1.0).asDiagonal().toDenseMatrix())),
            1);
}

}  // namespace
}  // namespace burnish
