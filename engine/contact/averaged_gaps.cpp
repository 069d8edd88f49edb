#include "engine/contact/averaged_gaps.h"

#include <fmt/format.h>

#include "engine/core/error.h"

namespace burnish {
namespace {

/// Smallest integral of a basis function over the contact face, as a share of the largest, that an averaged
/// gap is made with; what vanishes in exact arithmetic stays below it.
constexpr double kSmallestShare = 1e-12;

}  // namespace

void requireAveragedGaps(const Eigen::VectorXd& weights, bool axisymmetric) {
  if (weights.minCoeff() > kSmallestShare * weights.maxCoeff()) return;
  throw Error(
      fmt::format("contact: a basis function has no positive integral over the contact face, so its averaged "
                  "gap is not defined; use a NURBS basis{}",
                  axisymmetric ? ", or Lagrange elements of degree 1 where the face meets the axis"
                               : " or Lagrange elements of degree 7 at most"));
}

}  // namespace burnish
