#pragma once
#include <Eigen/Sparse>
#include <vector>

#include "engine/solver/division.h"

namespace burnish::inline solver {

/// Nested spaces of displacements, from the finest to the coarsest. Each matrix makes coefficients on one
/// level from those on the next coarser one: free displacement components of the two levels.
struct Hierarchy {
  using Prolongation = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  std::vector<Prolongation> prolongations;
  std::vector<NodeGrid> grids;  ///< whose displacements the finest level has
};

}  // namespace burnish::inline solver
