#pragma once
#include <Eigen/Sparse>

namespace burnish {

/// What a matrix
///
///     A = [ K  B ]
///         [ G  C ]
///
/// has beside K: entries that are not zero.
struct SystemBorder {
  Eigen::SparseMatrix<double> B;
  Eigen::SparseMatrix<double, Eigen::RowMajor> G;
  Eigen::SparseMatrix<double> C;

  /// Whether K is coupled with the border at present.
  bool isCoupled() const { return B.nonZeros() > 0 || G.nonZeros() > 0; }
};

/// The matrix A of a linear system, of one pattern for good that is symmetric; rows ascend in every column.
class SystemMatrix {
 public:
  virtual ~SystemMatrix() = default;

  /// All of A; made when it is asked for.
  virtual const Eigen::SparseMatrix<double>& whole() = 0;

  /// K, whose arrays stay where they are.
  virtual const Eigen::SparseMatrix<double>& leading() const = 0;

  virtual SystemBorder border() const = 0;
};

}  // namespace burnish
