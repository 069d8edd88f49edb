#include "engine/tools/shapes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "engine/tools/shape_problems.h"

namespace burnish::inline tools {
namespace {

bool fits(ForBodies bodies, const ShapeProblems& problems) {
  switch (bodies) {
    case ForBodies::All:
      return true;
    case ForBodies::Planar:
      return problems.dim() == 2;
    case ForBodies::Spatial:
      return problems.dim() == 3;
    case ForBodies::SpatialOrAxisymmetric:
      return problems.dim() == 3 || problems.isAxisymmetric();
  }
  return true;
}

const char* textOf(ForBodies bodies) {
  if (bodies == ForBodies::Planar) return "two-dimensional";
  return bodies == ForBodies::Spatial ? "three-dimensional" : "three-dimensional or axisymmetric";
}

}  // namespace

void requireBody(const ShapeProblems& problems, std::span<const ShapeKind> kinds, std::size_t found) {
  const ShapeKind& kind = kinds[found];
  if (problems.dim() == 0 || fits(kind.bodies, problems)) return;
  std::vector<std::string> allowed;
  for (const ShapeKind& other : kinds)
    if (fits(other.bodies, problems)) allowed.emplace_back(other.key);
  problems.report("shape", fmt::format("found {}, which needs a {} body; allowed here: {}.", kind.key,
                                       textOf(kind.bodies), fmt::join(allowed, " | ")));
}

}  // namespace burnish::inline tools
