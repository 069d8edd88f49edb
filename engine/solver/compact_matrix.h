#pragma once
#include <vector>

#include "engine/solver/chunked_rows.h"

namespace burnish::inline solver {

/// A matrix in single precision, products in double precision: they are linear to rounding, and what a smoother needs to
/// know of a matrix. At degree 2 it takes five bytes an entry instead of 12, and a product a fifth of the time.
class CompactMatrix {
 public:
  explicit CompactMatrix(const RowGroups& groups) : groups_(&groups), rows_(groups, false) {}

  /// On the groups' pattern.
  void assign(const SparseRows& A);

  /// y = A x. Not thread-safe.
  void multiply(const double* x, double* y) const;

 private:
  const RowGroups* groups_;
  ChunkedRows rows_;
  mutable std::vector<double> x_;  ///< as long as chunks are read
};

}  // namespace burnish::inline solver
