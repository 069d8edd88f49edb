#include "postproc/draw/contour/free_sky.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

namespace burnish {
namespace {

/// With 256 rays a share is off by 0.003 (root mean square); with the fewest by 0.008.
constexpr Eigen::Index kFewestRaysOfPoint = 64;

/// Beyond these a point gets fewer.
constexpr Eigen::Index kRaysOfPicture = 8'000'000;

/// Directions about the z axis, 3 x count (a multiple of four), in a spiral whose turns have equal shares of cosine-weighted
/// space: a quarter of it, and its images in x, in y and in both.
Eigen::Matrix3Xd spiral(Eigen::Index count) {
  constexpr double kGolden = 0.3819660112501051;  // of a turn
  const Eigen::Index quarter = count / 4;
  Eigen::Matrix3Xd directions(3, count);
  for (Eigen::Index k = 0; k < quarter; ++k) {
    const auto number = static_cast<double>(k);
    const double square = (number + 0.5) / static_cast<double>(quarter), radius = std::sqrt(square),
                 angle = 0.5 * std::numbers::pi * (kGolden * number - std::floor(kGolden * number)),
                 x = radius * std::cos(angle), y = radius * std::sin(angle), z = std::sqrt(1.0 - square);
    directions.middleCols<4>(4 * k) << x, -x, x, -x, y, y, -y, -y, z, z, z, z;
  }
  return directions;
}

/// Columns: two directions across a unit normal, and the normal. The first one lies with it and an axis in a plane, so
/// that of a mirror image across an axis it is the image or its opposite.
Eigen::Matrix3d frameOf(const Eigen::Vector3d& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().minCoeff(&axis);
  Eigen::Matrix3d frame;
  frame.col(2) = normal;
  frame.col(0) = (Eigen::Vector3d::Unit(axis) - normal(axis) * normal).normalized();
  frame.col(1) = normal.cross(frame.col(0));
  return frame;
}

RaySpace spaceOf(Surfaces bodies, const Surfaces& tools) {
  bodies.insert(bodies.end(), tools.begin(), tools.end());
  return raySpaceOf(bodies);
}

}  // namespace

FreeSky::FreeSky(const Surfaces& bodies, const Surfaces& tools, double toolOpacity)
    : space_(spaceOf(bodies, tools)),
      bodies_(bodies, space_),
      tools_(tools, space_),
      toolOpacity_(toolOpacity) {}

Eigen::VectorXd FreeSky::sharesAt(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& normals,
                                  const Rays& rays) const {
  Eigen::VectorXd shares(points.cols());
  if (points.cols() == 0) return shares;
  const Eigen::Index wanted = std::clamp(kRaysOfPicture / points.cols(), kFewestRaysOfPoint, rays.most),
                     count = wanted / kRayPacket * kRayPacket;
  const Eigen::Matrix3Xd directions = spiral(count);
  const auto reach = static_cast<float>(space_.scale * rays.reach);
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, points.cols(), 64), [&](const auto& range) {
    for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
      const Eigen::Vector3d x = points.col(i), n = normals.col(i);
      if (!(n.squaredNorm() > 0.0)) {  // of a face that has shrunk to a line or a point
        shares(i) = 1.0;
        continue;
      }
      const Eigen::Vector3f amongBodies = space_.place(x + rays.amongBodies * n),
                            amongTools = space_.place(x + rays.amongTools * n);
      const Eigen::Matrix3d frame = frameOf(n);
      int free = 0, throughTools = 0;
      for (Eigen::Index k = 0; k < count; k += kRayPacket) {
        const RayPacket packet = (frame * directions.middleCols<kRayPacket>(k)).cast<float>();
        const unsigned past = kAllOfPacket & ~bodies_.stopped(amongBodies, packet, reach, kAllOfPacket),
                       dimmed = tools_.stopped(amongTools, packet, reach, past);
        free += std::popcount(past & ~dimmed);
        throughTools += std::popcount(dimmed);
      }
      shares(i) = (free + (1.0 - toolOpacity_) * throughTools) / static_cast<double>(count);
    }
  });
  return shares;
}

}  // namespace burnish
