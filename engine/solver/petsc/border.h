#pragma once
#include <Eigen/Sparse>
#include <Eigen/UmfPackSupport>
#include <vector>

#include "engine/core/team.h"
#include "engine/solver/system_matrix.h"

namespace burnish::inline solver {

/// A over the border and a zone of the first n unknowns,
///
///     [ K_zz  B_z ]
///     [ G_z   C   ],
///
/// whose Schur complement of K_zz stands for that of K. The zone is what is coupled with the border and, unless that is
/// too much, what K couples with it: a pressure is met by what lies below the surface. Of several ranks the last one
/// has the factors.
class BorderZone {
 public:
  BorderZone();

  /// firstColumn: of K that this rank has. False if it is singular.
  bool factorise(const SystemMatrix& A, const SystemBorder& border, const Team& team, int firstColumn);

  /// The border's part of its solution with the right-hand side (0, g). For the last rank.
  Eigen::VectorXd solve(const Eigen::VectorXd& g);

 private:
  /// Entries of K between unknowns that have a place, at these places; of all ranks.
  static std::vector<Eigen::Triplet<double>> entriesOfK(const SystemMatrix& A, const std::vector<int>& place,
                                                        const Team& team, int firstColumn);

  std::vector<int> unknowns_;      ///< of K, ascending
  Eigen::SparseMatrix<double> M_;  ///< which the factors refer to
  Eigen::UmfPackLU<Eigen::SparseMatrix<double>> lu_;
};

}  // namespace burnish::inline solver
