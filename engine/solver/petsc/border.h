#pragma once
#include <Eigen/Sparse>
#include <Eigen/UmfPackSupport>
#include <vector>

#include "engine/core/team.h"
#include "engine/solver/system_matrix.h"

namespace burnish::inline solver {

/// A over the border and a zone of the unknowns of K,
///
///     [ K_zz  B_z ]
///     [ G_z   C   ],
///
/// with products of K left out. The zone is what is coupled with the border and, unless that is too much, what K couples
/// with it: a pressure is met by what lies below the surface. Of several ranks the last one has the factors.
class BorderZone {
 public:
  BorderZone();

  /// firstColumn: of K that this rank has. False if it is singular.
  bool factorise(const SystemMatrix& A, const SystemBorder& border, const Team& team, int firstColumn);

  /// Unknowns of K in the zone, ascending; on all ranks.
  const std::vector<int>& unknowns() const { return unknowns_; }

  /// The solution, of the zone and behind it of the border, for a right-hand side in this order. For the last rank.
  Eigen::VectorXd solve(const Eigen::VectorXd& r);

 private:
  /// Entries of K between unknowns that have a place, at these places; of all ranks.
  static std::vector<Eigen::Triplet<double>> entriesOfK(const SystemMatrix& A, const std::vector<int>& place,
                                                        const Team& team, int firstColumn);

  std::vector<int> unknowns_;
  Eigen::SparseMatrix<double> M_;  ///< which the factors refer to
  Eigen::UmfPackLU<Eigen::SparseMatrix<double>> lu_;
};

}  // namespace burnish::inline solver
