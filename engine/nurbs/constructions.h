#pragma once
#include "engine/nurbs/patch.h"

/// Patches made of curves and faces in space. Those of a profile of P parameters have its parameters first, then one
/// along the new direction, which begins with the profile itself.
namespace burnish::inline nurbs {

/// The profile moved along a vector: degree 1, one span. Exact.
template <int P>
Patch<P + 1, 3> extruded(const Patch<P, 3>& profile, const Eigen::Vector3d& vector);

/// The profile turned about an axis by an angle in radians, from 0 to 2π, in rational arcs of at most a right angle:
/// degree 2. Exact.
template <int P>
Patch<P + 1, 3> revolved(const Patch<P, 3>& profile, const Eigen::Vector3d& center,
                         const Eigen::Vector3d& axis, double angle);

/// The profile carried along a curve, turned with its tangent but never about it (rotation-minimising frames, by
/// double reflection: Wang et al. 2008). Exact along a straight line and along a circular arc; else splines of the
/// degree of the path, at least 3, on its knots, divided until no point of the profile is farther than `tolerance`
/// from where it should be. Throws `Error` for a path that stands still, has a corner, or takes too many knots.
template <int P>
Patch<P + 1, 3> sweptAlong(const Patch<P, 3>& profile, const Patch<1, 3>& path, double tolerance);

/// The patch between four curves, bilinearly blended (Coons 1967): the second and fourth of them run along the second
/// parameter. They must meet in the corners, where the weights of a curve must be alike. Parameters over [0, 1], degrees
/// and knots those that the curves have in common. Throws `Error` if a weight of the patch is not positive.
Patch<2, 3> coonsPatch(const Patch<1, 3>& bottom, const Patch<1, 3>& right, const Patch<1, 3>& top,
                       const Patch<1, 3>& left);

/// Length of a curve.
double lengthOf(const Patch<1, 3>& curve);

/// A face in the plane z = 0 as one of two dimensions.
Patch<2> inPlane(const Patch<2, 3>& face);

}  // namespace burnish::inline nurbs
