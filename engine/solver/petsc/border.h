#pragma once
#include <Eigen/Sparse>
#include <Eigen/UmfPackSupport>
#include <vector>

namespace burnish {

/// The parts of a matrix
///
///     A = [ K  B ]
///         [ G  C ]
///
/// with K over the first n unknowns, by rows; of the border what is not zero.
class SplitMatrix {
 public:
  using Columns = Eigen::SparseMatrix<double>;
  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  SplitMatrix(Eigen::Index leading, bool symmetric) : n_(leading), symmetric_(symmetric) {}

  /// All matrices must have the pattern of the first one, which is symmetric; rows ascend in every column.
  /// The arrays of K stay where they are.
  void take(const Columns& A);

  const Rows& K() const { return K_; }
  const Columns& B() const { return B_; }
  const Rows& G() const { return G_; }
  const Columns& C() const { return C_; }

  /// Whether K is coupled with the border at present.
  bool isCoupled() const { return B_.nonZeros() > 0 || G_.nonZeros() > 0; }

 private:
  void analyse(const Columns& A);
  void takeLeading(const Columns& A);

  Eigen::Index n_;
  bool symmetric_;
  Rows K_;
  std::vector<int> from_;  ///< entry of A behind each entry of K; empty if A is symmetric
  Columns B_, C_;
  Rows G_;
};

/// A over the border and those of the first n unknowns that are coupled with it,
///
///     [ K_zz  B_z ]
///     [ G_z   C   ],
///
/// whose Schur complement of K_zz stands for that of K.
class BorderZone {
 public:
  /// False if it is singular.
  bool factorise(const SplitMatrix& A);

  /// The border's part of its solution with the right-hand side (0, g).
  Eigen::VectorXd solve(const Eigen::VectorXd& g);

 private:
  std::vector<int> unknowns_;      ///< of K, ascending
  Eigen::SparseMatrix<double> M_;  ///< which the factors refer to
  Eigen::UmfPackLU<Eigen::SparseMatrix<double>> lu_;
};

}  // namespace burnish
