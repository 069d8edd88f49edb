#include "engine/tools/union.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "engine/core/key_error.h"
#include "engine/tools/outline_parts.h"
#include "engine/tools/shape_problems.h"

namespace burnish::inline tools {
namespace {

using Eigen::Vector3d;

/// Minimum of a and b, smooth where they differ by less than the width k: (a+b)/2 + f(a-b) with
/// f(d) = -|d|/2 - k/6 (1-|d|/k)³.
GapQuery smoothMinimum(const GapQuery& a, const GapQuery& b, double width) {
  const double d = a.gap - b.gap;
  if (std::abs(d) >= width) return d < 0.0 ? a : b;
  const double h = 1.0 - std::abs(d) / width;
  const double f = -0.5 * std::abs(d) - width / 6.0 * h * h * h;
  const double df = std::copysign(0.5 * (1.0 - h * h), -d);
  const double ddf = -h / width;
  const Vector3d difference = a.normal - b.normal;
  GapQuery answer;
  answer.gap = 0.5 * (a.gap + b.gap) + f;
  answer.normal = 0.5 * (a.normal + b.normal) + df * difference;
  answer.dNormal = 0.5 * (a.dNormal + b.dNormal) + df * (a.dNormal - b.dNormal) +
                   ddf * difference * difference.transpose();
  answer.part = d < 0.0 ? a.part : b.part;
  return answer;
}

/// The point of a common surface near x. Where the normals of two parts cancel there may be none.
Vector3d onSurface(const Union& joined, Vector3d x) {
  constexpr double kFlattest = 0.1;
  for (int step = 0; step < 4; ++step) {
    const GapQuery query = joined.query(x);
    if (query.normal.norm() < kFlattest) break;
    x -= query.gap * query.normal / query.normal.squaredNorm();
  }
  return x;
}

}  // namespace

GapQuery Union::query(const Vector3d& x) const {
  constexpr int kMostParts = 1024;  // of one of the shapes
  GapQuery answer = parts.front().query(x);
  for (std::size_t k = 1; k < parts.size(); ++k) {
    GapQuery other = parts[k].query(x);
    other.part += kMostParts * static_cast<int>(k);
    answer = smoothMinimum(answer, other, blend);
  }
  return answer;
}

double Union::halfThickness() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const RigidShape& part : parts) smallest = std::min(smallest, part.halfThickness());
  return smallest;
}

double Union::bulge() const {
  double largest = 0.0;
  for (const RigidShape& part : parts) largest = std::max(largest, part.bulge());
  return largest;
}

Vector3d Union::middle() const {
  Vector3d sum = Vector3d::Zero();
  for (const RigidShape& part : parts) sum += part.middle();
  return sum / static_cast<double>(parts.size());
}

/// The parts without what is inside of other parts, cut finely and moved onto the common surface.
SurfaceMesh Union::outline(int dim, double reach) const {
  std::vector<SurfaceMesh> outlines;
  for (const RigidShape& part : parts) {
    const auto others = [&](const Vector3d& x) {
      double smallest = reach;
      for (const RigidShape& other : parts)
        if (&other != &part) smallest = std::min(smallest, other.query(x).gap);
      return smallest;
    };
    const double finest = blend > 0.0 ? std::min(reach / 40.0, blend / 4.0) : reach / 40.0;
    SurfaceMesh outline = clipped(refined(part.outline(dim, reach), finest), others);
    for (auto point : outline.points.colwise()) point = onSurface(*this, point);
    const auto offSurface = [&](const Vector3d& x) { return 0.1 * finest - std::abs(query(x).gap); };
    outlines.push_back(clipped(outline, offSurface));
  }
  return together(outlines);
}

Union UnionTool::made() const {
  Union joined{{}, blend};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    try {
      joined.parts.push_back(makeShape(parts[i].shape, parts[i].inside));
    } catch (const KeyError& error) {
      throw KeyError(fmt::format("parts[{}].{}", i, error.key()), error.what());
    }
  }
  return joined;
}

void check(const UnionTool& joined, const ShapeProblems& problems) {
  for (std::size_t i = 0; i < joined.parts.size(); ++i)
    if (const ShapeProblems ofPart = problems.ofPart(fmt::format("parts[{}]", i)); ofPart.clean("shape"))
      checkShape(joined.parts[i].shape, ofPart);
}

}  // namespace burnish::inline tools
