#include "engine/contact/averaged_gaps.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/error.h"

namespace burnish::inline contact {
namespace {

/// Smallest integral of a basis function over the contact face, as a share of the largest, that an averaged
/// gap is made with; what vanishes in exact arithmetic stays below it.
constexpr double kSmallestShare = 1e-12;

}  // namespace

int FaceContactState::numActive() const {
  return static_cast<int>(std::count(active.begin(), active.end(), true));
}

double FaceContactState::largestPenetration() const {
  return gap.size() == 0 ? 0.0 : std::max(0.0, -gap.minCoeff());
}

void FaceContactState::countChanges(const std::vector<bool>& before) {
  changes = 0;
  for (std::size_t a = 0; a < std::min(before.size(), active.size()); ++a)
    changes += before[a] != active[a] ? 1 : 0;
}

template <int Dim>
int contactPoints(const Body<Dim>& body, int patch, std::optional<int> wanted) {
  if (wanted) return *wanted;
  int degree = 1;
  for (int d = 0; d < Dim; ++d)
    degree = std::max(degree, body.patches[static_cast<std::size_t>(patch)].basis().direction(d).degree());
  return 2 * degree;
}

LimitedGap limitedGap(double gap, double limit) {
  if (!(gap > limit)) return {gap, 1.0, 0.0};
  const double width = 2.0 * limit, s = (gap - limit) / width;
  if (s >= 1.0) return {2.0 * limit, 0.0, 0.0};
  return {limit + width * (s - s * s * s + 0.5 * s * s * s * s), (1.0 - s) * (1.0 - s) * (1.0 + 2.0 * s),
          -6.0 * s * (1.0 - s) / width};
}

Eigen::MatrixXd averagedGapTangent(const Eigen::Ref<const Eigen::VectorXd>& D, double stiffness,
                                   bool hasMultiplier) {
  const Eigen::Index n = D.size(), size = n + (hasMultiplier ? 1 : 0);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
  K.topLeftCorner(n, n) = stiffness * D * D.transpose();
  if (!hasMultiplier) return K;
  K.col(n).head(n) = D;
  K.row(n).head(n) = D.transpose();
  return K;
}

void requireAveragedGaps(const Eigen::VectorXd& weights, bool axisymmetric) {
  if (weights.minCoeff() > kSmallestShare * weights.maxCoeff()) return;
  throw Error(
      fmt::format("contact: a basis function has no positive integral over the contact face, so its averaged "
                  "gap is not defined; use a NURBS basis{}",
                  axisymmetric ? ", or Lagrange elements of degree 1 where the face meets the axis"
                               : " or Lagrange elements of degree 7 at most"));
}

template int contactPoints(const Body<2>&, int, std::optional<int>);
template int contactPoints(const Body<3>&, int, std::optional<int>);

}  // namespace burnish::inline contact
