#include "engine/tools/shape_problems.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

namespace burnish::inline tools {

void ShapeProblems::requireFront(const char* key, const Direction& direction) const {
  if (clean(key) && direction.isZero(0.0))
    report(key, "found a vector without length; allowed: a direction from the tool to the front.");
}

void ShapeProblems::requireAxis(const char* key, const Eigen::Vector3d& axis) const {
  if (!Problems::clean(key)) return;
  if (axis.isZero(0.0))
    report(key, fmt::format("found [{}]; allowed: a direction.", entriesText(axis)));
  else if (dim() == 2 && (axis.x() != 0.0 || axis.y() != 0.0))
    report(key, fmt::format("found [{}]; allowed in two dimensions: [0, 0, 1].", entriesText(axis)));
}

void ShapeProblems::requireDimension(const char* key, const std::vector<std::vector<double>>& points,
                                     int dim) const {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::ssize(points[i]) != dim)
      report(fmt::format("{}[{}]", key, i),
             fmt::format("found {} coordinates; allowed: {}, one per dimension of the body.",
                         points[i].size(), dim));
}

std::string entriesText(const Coordinates& coordinates) {
  return fmt::format("{}", fmt::join(coordinates.given(), ", "));
}

bool areParallel(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.cross(b).norm() <= 1e-9 * a.norm() * b.norm();
}

}  // namespace burnish::inline tools
