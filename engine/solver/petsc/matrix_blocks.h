#pragma once
#include <span>

#include "engine/solver/petsc/library.h"
#include "engine/solver/row_groups.h"

namespace burnish::inline solver::petsc {

/// Of this rank's rows of a matrix of the library.
struct MatrixBlocks {
  explicit MatrixBlocks(Mat A);

  Mat diagonal;
  Mat offDiagonal = nullptr;  ///< columns of other ranks, numbered anew; null in a process that is alone
};

/// The rows of a matrix that one process has, in the library's arrays.
SparseRows rowsOf(Mat matrix);

/// The library does not know that the values of a matrix have changed; as long as it does not, smoothers keep what they
/// have made of others.
void noteChangedValues(Mat matrix);

/// Those numbers of vectors that other ranks have and this one's rows of a matrix need. The matrix has to stay.
class GhostValues {
 public:
  explicit GhostValues(Mat A);

  /// What is done between these does not wait for other ranks.
  void begin(Vec x);
  void end(Vec x);

  /// Of the last vector, in the order of the off-diagonal block's columns.
  Vec values() const { return values_; }

  /// Which ones of the whole vector these are.
  std::span<const PetscInt> numbers() const { return numbers_; }

  /// Adds the values to those numbers of a vector.
  void addTo(Vec x);

 private:
  std::span<const PetscInt> numbers_;  ///< the matrix's
  Vector values_;
  Scatter scatter_;
};

}  // namespace burnish::inline solver::petsc
