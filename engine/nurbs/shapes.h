#pragma once
#include "engine/nurbs/patch.h"

/// Exact shapes on their coarsest bases; all parameters run over [0, 1]. Angles in radians; arcs must open
/// less than π.
namespace burnish {

Patch<2> rectangle(const Eigen::Vector2d& origin, const Eigen::Vector2d& size);

/// Part of a ring: parameter 1 along the radius (inner to outer), parameter 2 along the angle. Degrees 1
/// and 2.
Patch<2> annulus(const Eigen::Vector2d& center, double innerRadius, double outerRadius, double startAngle,
                 double openingAngle);

Patch<3> box(const Eigen::Vector3d& origin, const Eigen::Vector3d& size);

/// Part of a tube about the z axis through `center`: radius, angle, height. Degrees 1, 2 and 1.
Patch<3> cylinderSegment(const Eigen::Vector3d& center, double innerRadius, double outerRadius,
                         double startAngle, double openingAngle, double height);

/// Part of a spherical shell: radius, longitude, latitude (from -π/2 to π/2). Degrees 1, 2 and 2.
Patch<3> sphereSegment(const Eigen::Vector3d& center, double innerRadius, double outerRadius,
                       const Eigen::Vector2d& longitudes, const Eigen::Vector2d& latitudes);

}  // namespace burnish
