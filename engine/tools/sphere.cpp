#include "engine/tools/sphere.h"

#include <cmath>
#include <vector>

#include "engine/tools/outline_parts.h"
#include "engine/tools/profile_gap.h"

namespace burnish::inline tools {

using Eigen::Vector3d;

GapQuery Sphere::query(const Vector3d& x) const {
  return roundGap(x - center, Eigen::Matrix3d::Identity(), radius);
}

SurfaceMesh Sphere::outline(int /*dim*/, double /*reach*/) const {
  std::vector<Eigen::Vector2d> profile;
  for (int k = 0; k <= kPiecesAround / 2; ++k)
    profile.emplace_back(radius * std::sin(k * kPieceAngle), -radius * std::cos(k * kPieceAngle));
  SurfaceMesh mesh = revolved(profile, center, Vector3d::UnitZ(), false);
  mesh.closed = true;
  return mesh;
}

bool Sphere::isSound() const {
  return center.allFinite() && std::isfinite(radius) && radius > 0.0;
}

}  // namespace burnish::inline tools
