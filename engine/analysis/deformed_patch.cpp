#include "engine/analysis/deformed_patch.h"

#include <cstddef>
#include <utility>

namespace burnish::inline analysis {

Patch<2> deformedPatch(const Body<2>& body, const Eigen::VectorXd& x) {
  const Patch<2>& patch = body.patches.front();
  Eigen::MatrixXd points = patch.points();
  for (Eigen::Index a = 0; a < points.cols(); ++a)
    points.col(a) += x.segment<2>(2 * Eigen::Index{body.nodes.front()[static_cast<std::size_t>(a)]});
  return {patch.basis(), std::move(points), patch.weights()};
}

Eigen::VectorXd valueAt(const Patch<2>& patch, const Eigen::MatrixXd& coefficients,
                        const Eigen::Vector2d& xi) {
  const int span = patch.findSpan(xi);
  return coefficients(Eigen::all, patch.basis().spanFunctions(span)) * patch.shape(span, xi).R;
}

}  // namespace burnish::inline analysis
