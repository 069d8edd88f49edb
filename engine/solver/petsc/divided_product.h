#pragma once
#include <optional>
#include <vector>

#include "engine/solver/division.h"
#include "engine/solver/galerkin_product.h"
#include "engine/solver/petsc/library.h"
#include "engine/solver/row_groups.h"

namespace burnish::inline solver {

/// PᵀAP of several ranks, for matrices A of one pattern: each multiplies its rows, and sends what belongs to rows of others to
/// these. They add it in the order of the ranks, so that equal runs have equal bits. All ranks make one together, and assign
/// together.
class DividedProduct {
 public:
  /// groups: of A's diagonal block; they have to stay. P: all of it. rows, columns: which of its rows and columns the ranks have.
  DividedProduct(Mat A, const RowGroups& groups, const Hierarchy::Prolongation& P, const Division& rows,
                 const Division& columns);
  DividedProduct(const DividedProduct&) = delete;
  DividedProduct& operator=(const DividedProduct&) = delete;

  void assign(Mat A);

  /// Of the A that was assigned last; stays the same object.
  Mat matrix() const { return matrix_; }

 private:
  /// What comes from a rank, this one included: to which entries it is added, of the diagonal block or, as the complement, of
  /// the off-diagonal one.
  struct Share {
    int rank = 0;
    std::vector<int> targets;
    std::vector<double> values;  ///< as they came; those of this rank are where they were made
  };
  /// Rows of a block, in arrays that the library looks at.
  struct Block {
    std::vector<int> begins{0}, columns;
    std::vector<double> values;
  };

  void makeProduct(Mat A, const RowGroups& groups, const Hierarchy::Prolongation& P, const Division& rows,
                   const std::vector<int>& placeOf);
  std::vector<std::vector<int>> patternsOfRanks() const;
  void makeMatrix(const std::vector<std::vector<int>>& patterns, const Division& columns, int numColumns);
  void add(const Share& share, const double* values);

  int rank_ = 0;
  MPI_Comm ranks_ = MPI_COMM_NULL;
  int tag_ = 0;
  std::vector<int> places_;  ///< of the columns that this rank's product has, ascending
  std::vector<int> begins_;  ///< those of rank r are from begins_[r] on
  Hierarchy::Prolongation own_, ofElsewhere_;
  std::optional<GalerkinProduct> product_;
  std::vector<Share> shares_;  ///< by ranks
  Block diagonal_, offDiagonal_;
  petsc::Matrix matrix_;
};

}  // namespace burnish::inline solver
