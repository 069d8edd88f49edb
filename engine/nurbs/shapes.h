#pragma once
#include "engine/nurbs/patch.h"

/// Exact shapes on their coarsest bases; all parameters run over [0, 1]. Angles in radians; arcs must open
/// less than π.
namespace burnish::inline nurbs {

Patch<2> rectangle(const Eigen::Vector2d& origin, const Eigen::Vector2d& size);

/// Part of a ring: parameter 1 along the radius (inner to outer), parameter 2 along the angle. Degrees 1
/// and 2.
Patch<2> annulus(const Eigen::Vector2d& center, double innerRadius, double outerRadius, double startAngle,
                 double openingAngle);

/// A whole disc as one patch: four arcs of a right angle, the one of the face `right` around the start angle,
/// between corners at which the map is not invertible. Degrees 2 and 2.
Patch<2> disc(const Eigen::Vector2d& center, double radius, double startAngle);

/// Part of a disc: parameter 1 along its first radius, parameter 2 along the second one; the faces `right`
/// and `top` are the halves of the arc, between which the map is not invertible. Degrees 2 and 2.
Patch<2> discSector(const Eigen::Vector2d& center, double radius, double startAngle, double openingAngle);

/// A whole ellipse of this width and height: a disc, stretched along x and y.
Patch<2> ellipse(const Eigen::Vector2d& center, const Eigen::Vector2d& size);

Patch<3> box(const Eigen::Vector3d& origin, const Eigen::Vector3d& size);

/// A plane patch swept along an axis, third parameter: the plane's origin goes from `begin` in the direction
/// of `axis` as far as `length`, its x axis points to the coordinate axis that follows the largest component
/// of `axis` (x, y, z, x: to x for an axis along z). Degree 1 along the axis.
Patch<3> swept(const Patch<2>& base, const Eigen::Vector3d& begin, const Eigen::Vector3d& axis,
               double length);

/// Part of a tube about the z axis through `center`: radius, angle, height. Degrees 1, 2 and 1.
Patch<3> cylinderSegment(const Eigen::Vector3d& center, double innerRadius, double outerRadius,
                         double startAngle, double openingAngle, double height);

/// Part of a spherical shell: radius, longitude, latitude (from -π/2 to π/2). Degrees 1, 2 and 2.
Patch<3> sphereSegment(const Eigen::Vector3d& center, double innerRadius, double outerRadius,
                       const Eigen::Vector2d& longitudes, const Eigen::Vector2d& latitudes);

/// An eighth of a ball: half of it, with its `pole` in the middle, cut by two planes of symmetry. Radius,
/// longitude and latitude about a diameter normal to the pole: the sphere is the face `right`, with the pole
/// at a corner where the map is regular; `bottom` and `back` are the planes of symmetry, `top` is the plane
/// through the centre, with the direction of the x axis of `swept`; `left` collapses to the centre, `front`
/// to the diameter. Degrees 1, 2 and 2.
Patch<3> ballOctant(const Eigen::Vector3d& center, double radius, const Eigen::Vector3d& pole);

}  // namespace burnish::inline nurbs
