#pragma once
#include <Eigen/Dense>

#include "engine/tools/gap_query.h"

/// Gaps that round shapes are made of.
namespace burnish::inline tools {

/// Gap to a surface at distance R from a point or an axis, eq. (27); `v` leads from there to x and lies in
/// the range of the projector I_⊥. On the axis itself any direction is as good as another; the curvature term
/// is left at zero.
GapQuery roundGap(const Eigen::Vector3d& v, const Eigen::Matrix3d& projector, double radius);

/// Gap of a plane figure that is the same on both sides of an axis, at distance r from the axis and height h
/// along it: its derivatives by (r, h).
struct ProfileGap {
  double gap = 0.0;
  Eigen::Vector2d normal = Eigen::Vector2d::UnitY();
  Eigen::Matrix2d dNormal = Eigen::Matrix2d::Zero();
  int part = 0;  ///< as of `GapQuery`
};

/// Distance to a point less a radius; straight ahead in the point itself.
ProfileGap circleProfile(const Eigen::Vector2d& fromCenter, double radius);

/// A wedge with its tip at the origin that opens downwards: the sharp wedge with its tip in the centre of the
/// rounding, grown by the radius. Its flank is part 1. halfAngle: radians, below π/2.
ProfileGap wedgeProfile(double r, double h, double halfAngle, double radius);

/// A point by its distance r from an axis and its height h along it.
struct AxisPlace {
  Eigen::Vector3d axis;    ///< unit
  Eigen::Vector3d radial;  ///< unit, away from the axis
  double r, h;
};

AxisPlace placeAbout(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, const Eigen::Vector3d& x);

/// The profile in the plane of a radial and an axial direction.
GapQuery lifted(const ProfileGap& profile, const Eigen::Vector3d& radial, const Eigen::Vector3d& axis);

/// The profile turned about the axis: its circles add the curvature n_r / r, on the axis the limit ∂n_r/∂r.
GapQuery turned(const ProfileGap& profile, const AxisPlace& place);

}  // namespace burnish::inline tools
