#include "engine/tools/combined_shapes.h"

#include <cmath>

#include "engine/tools/rigid_shape.h"

namespace burnish {
namespace {

/// Minimum of a and b, smooth where they differ by less than the width k: (a+b)/2 + f(a-b) with
/// f(d) = -|d|/2 - k/6 (1-|d|/k)³.
GapQuery smoothMinimum(const GapQuery& a, const GapQuery& b, double width) {
  const double d = a.gap - b.gap;
  if (std::abs(d) >= width) return d < 0.0 ? a : b;
  const double h = 1.0 - std::abs(d) / width;
  const double f = -0.5 * std::abs(d) - width / 6.0 * h * h * h;
  const double df = std::copysign(0.5 * (1.0 - h * h), -d);
  const double ddf = -h / width;
  const Eigen::Vector3d difference = a.normal - b.normal;
  GapQuery answer;
  answer.gap = 0.5 * (a.gap + b.gap) + f;
  answer.normal = 0.5 * (a.normal + b.normal) + df * difference;
  answer.dNormal = 0.5 * (a.dNormal + b.dNormal) + df * (a.dNormal - b.dNormal) +
                   ddf * difference * difference.transpose();
  return answer;
}

}  // namespace

GapQuery Die::query(const Eigen::Vector3d& x) const {
  return -queryGap(solid->shape, x);
}

GapQuery Union::query(const Eigen::Vector3d& x) const {
  GapQuery answer = queryGap(parts.front()->shape, x);
  for (auto part = parts.begin() + 1; part != parts.end(); ++part)
    answer = smoothMinimum(answer, queryGap((*part)->shape, x), blend);
  return answer;
}

}  // namespace burnish
