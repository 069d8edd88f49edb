#pragma once
#include <Eigen/Sparse>

#include "engine/solver/tangent_product.h"

namespace burnish::inline solver {

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

/// The matrix A of a linear system, of one pattern for good that is symmetric; rows ascend in every column. Where
/// several ranks divide the columns of K, each has its own ones and all of the border.
class SystemMatrix {
 public:
  virtual ~SystemMatrix() = default;

  /// Whether K is the sum of the entries below and of products, which `addProducts` multiplies by. These are
  /// symmetric.
  virtual bool hasProducts() const { return false; }

  /// Adds the products times x, over the rows of K, to y, over those of this rank's columns. Of x as much is needed
  /// as is coupled with these; to be called by all ranks together, with one precision.
  virtual void addProducts(const Eigen::VectorXd& /*x*/, Eigen::VectorXd& /*y*/,
                           Precision /*precision*/) const {}

  /// All of A, products included; made when it is asked for. Not of one that is divided.
  virtual const Eigen::SparseMatrix<double>& whole() = 0;

  /// Columns of K that are this rank's, in the rows with the same numbers: all of K if it is not divided. Its
  /// arrays stay where they are.
  virtual const Eigen::SparseMatrix<double>& leading() const = 0;

  /// The same columns in all other rows, under their numbers in K.
  virtual const Eigen::SparseMatrix<double>& leadingElsewhere() const = 0;

  virtual SystemBorder border() const = 0;
};

}  // namespace burnish::inline solver
