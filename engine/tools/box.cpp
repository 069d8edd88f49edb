#include "engine/tools/box.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/tools/outline_parts.h"
#include "engine/tools/profile_gap.h"
#include "engine/tools/shape_problems.h"

namespace burnish::inline tools {
namespace {

using Eigen::Vector3d;

/// Columns: the given first axis, the part of the second across it, and what is perpendicular to both.
Eigen::Matrix3d orthonormalAxes(const std::vector<std::vector<double>>& axes) {
  if (axes.empty()) return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d result;
  result.col(0) = Direction(axes[0]).normalized();
  const Vector3d second =
      axes.size() > 1 ? Vector3d(Direction(axes[1])) : Vector3d::UnitZ().cross(result.col(0));
  result.col(2) = result.col(0).cross(second).normalized();
  result.col(1) = result.col(2).cross(result.col(0));
  return result;
}

}  // namespace

GapQuery RoundedBox::query(const Vector3d& x) const {
  const Vector3d local = axes.transpose() * (x - center);
  const Vector3d side = local.unaryExpr([](double v) { return v < 0.0 ? -1.0 : 1.0; });
  const Vector3d beyond = local.cwiseAbs() - (0.5 * size.array() - radius).matrix();  // the core box
  constexpr std::array powersOfThree{1, 3, 9};
  const auto sideNumber = [&](Eigen::Index d) {
    return (side(d) < 0.0 ? 1 : 2) * powersOfThree.at(static_cast<std::size_t>(d));
  };
  GapQuery answer;
  if (Eigen::Index nearest = 0; beyond.maxCoeff(&nearest) <= 0.0) {
    answer.gap = beyond(nearest) - radius;
    answer.normal = side(nearest) * axes.col(nearest);
    answer.part = sideNumber(nearest);
    return answer;
  }
  const Vector3d isBeyond = (beyond.array() > 0.0).cast<double>();
  answer = roundGap(axes * beyond.cwiseMax(0.0).cwiseProduct(side),
                    axes * isBeyond.asDiagonal() * axes.transpose(), radius);
  for (Eigen::Index d = 0; d < 3; ++d)
    if (isBeyond(d) > 0.0) answer.part += sideNumber(d);
  return answer;
}

/// Its corners are those of the core box, grown by parts of a sphere (3D) or circle.
SurfaceMesh RoundedBox::outline(int dim, double /*reach*/) const {
  const auto corner = [&](double angle, double sideX, double sideY, double latitude, double sideZ) {
    const Vector3d side(sideX, sideY, sideZ);
    const Vector3d normal(std::cos(latitude) * std::cos(angle), std::cos(latitude) * std::sin(angle),
                          std::sin(latitude));
    Vector3d core = 0.5 * size - Vector3d::Constant(radius);
    if (dim == 2) core.z() = 0.0;
    return Vector3d(center + axes * (core.cwiseProduct(side) + radius * normal));
  };
  const int quarter = radius > 0.0 ? kPiecesAround / 4 : 0;
  const auto around = [&](double latitude, double sideZ) {
    OutlinePoints points;
    for (int q = 0; q < 4; ++q)
      for (int k = 0; k <= quarter; ++k)
        points.push_back(corner(q * 0.5 * std::numbers::pi + k * kPieceAngle, q == 0 || q == 3 ? 1.0 : -1.0,
                                q < 2 ? 1.0 : -1.0, latitude, sideZ));
    return points;
  };
  if (dim == 2) return line(around(0.0, 0.0), true);
  std::vector<OutlinePoints> rings;
  for (int k = -quarter; k <= 0; ++k) rings.push_back(around(k * kPieceAngle, -1.0));
  for (int k = 0; k <= quarter; ++k) rings.push_back(around(k * kPieceAngle, 1.0));
  rings.insert(rings.begin(), OutlinePoints(rings.front().size(), center - 0.5 * size.z() * axes.col(2)));
  rings.push_back(OutlinePoints(rings.front().size(), center + 0.5 * size.z() * axes.col(2)));
  SurfaceMesh mesh = strips(rings, true, false);
  mesh.closed = true;
  return mesh;
}

RoundedBox BoxTool::made() const {
  RoundedBox box{center, size, radius, orthonormalAxes(axes)};
  if (size.given().size() == 2) box.size.z() = std::numeric_limits<double>::infinity();
  return box;
}

void check(const BoxTool& box, const ShapeProblems& problems) {
  if (problems.clean("size") && problems.clean("radius")) {
    const std::vector<double> size = box.size.given();
    const double smallest = *std::min_element(size.begin(), size.end());
    if (2.0 * box.radius > smallest)
      problems.report("radius", fmt::format("found {}; allowed: at most {}, half the smallest size.",
                                            box.radius, 0.5 * smallest));
  }
  const int dim = problems.dim();
  if (box.axes.empty() || !problems.clean("axes") || dim == 0) return;
  const bool fits = std::ssize(box.axes) == dim - 1 && std::ranges::all_of(box.axes, [&](const auto& axis) {
                      return std::ssize(axis) == dim && !Direction(axis).isZero(0.0);
                    });
  if (!fits)
    problems.report("axes",
                    dim == 2 ? "found something else than one direction; allowed: [[x, y]]."
                             : "found something else than two directions; allowed: [[x, y, z], [x, y, z]].");
  else if (dim == 3 && areParallel(Direction(box.axes[0]), Direction(box.axes[1])))
    problems.report("axes", "found two parallel directions; allowed: two directions across one another.");
}

}  // namespace burnish::inline tools
