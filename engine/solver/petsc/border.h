#pragma once
#include <Eigen/Sparse>
#include <Eigen/UmfPackSupport>
#include <vector>

#include "engine/solver/system_matrix.h"

namespace burnish {

/// A over the border and those of the first n unknowns that are coupled with it,
///
///     [ K_zz  B_z ]
///     [ G_z   C   ],
///
/// whose Schur complement of K_zz stands for that of K.
class BorderZone {
 public:
  /// K: by columns. False if it is singular.
  bool factorise(const Eigen::SparseMatrix<double>& K, const SystemBorder& border);

  /// The border's part of its solution with the right-hand side (0, g).
  Eigen::VectorXd solve(const Eigen::VectorXd& g);

 private:
  std::vector<int> unknowns_;      ///< of K, ascending
  Eigen::SparseMatrix<double> M_;  ///< which the factors refer to
  Eigen::UmfPackLU<Eigen::SparseMatrix<double>> lu_;
};

}  // namespace burnish
