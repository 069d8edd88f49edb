#pragma once
#include <Eigen/Sparse>
#include <vector>

#include "engine/nurbs/univariate_basis.h"

namespace burnish::inline nurbs {

/// Which neighbouring spans become one when a mesh is made coarser.
struct MergeRule {
  double longest = 6.0;  ///< their sum, over the shortest span of any direction
  int most = 3;          ///< how many
};

/// Breakpoints that stay, ascending, the first and the last among them: neighbours are merged while their sum
/// is at most `rule.longest * shortest`; what is shorter than 1.5 * shortest then joins its shorter neighbour.
/// Longer spans stay, so that coarser and coarser meshes become uniform. lengths: of the spans; shortest: of
/// all spans of all directions.
std::vector<int> mergedBreakpoints(const std::vector<double>& lengths, double shortest,
                                   const MergeRule& rule);

/// The basis of the same family and degree with some of its breakpoints, `kept`, the first and the last
/// among them; those of a B-spline stay as often as they are there. Its space lies in that of `fine`.
UnivariateBasis coarsened(const UnivariateBasis& fine, const std::vector<int>& kept);

/// Matrix T (functions of `fine` x functions of `coarse`) such that coefficients c and T c describe the same
/// function, for two bases of one family and degree. Throws `Error` if the coarse space of splines is not in
/// the fine one.
Eigen::SparseMatrix<double, Eigen::RowMajor> transferMatrix(const UnivariateBasis& coarse,
                                                            const UnivariateBasis& fine);

}  // namespace burnish::inline nurbs
