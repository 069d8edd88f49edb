#include "engine/analysis/deformed_patch.h"

namespace burnish {

Patch<2> deformedPatch(const Patch<2>& patch, const Eigen::VectorXd& x) {
  const Eigen::Index n = patch.points().cols();
  return {patch.basis(), patch.points() + x.head(2 * n).reshaped(2, n), patch.weights()};
}

Eigen::VectorXd valueAt(const Patch<2>& patch, const Eigen::MatrixXd& coefficients,
                        const Eigen::Vector2d& xi) {
  const int span = patch.findSpan(xi);
  return coefficients(Eigen::all, patch.basis().spanFunctions(span)) * patch.shape(span, xi).R;
}

}  // namespace burnish
