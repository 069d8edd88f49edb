#include "engine/tools/analytic_shapes.h"

#include <cmath>

namespace burnish {
namespace {

/// Gap to a surface at distance R from a point or an axis, eq. (27); `v` leads from there to x and lies in
/// the range of the projector I_⊥. On the axis itself any direction is as good as another; the curvature term
/// is left at zero.
GapQuery roundGap(const Eigen::Vector3d& v, const Eigen::Matrix3d& projector, double radius) {
  GapQuery answer;
  const double distance = v.norm();
  answer.gap = distance - radius;
  if (distance == 0.0) {
    Eigen::Index longest = 0;
    projector.colwise().norm().maxCoeff(&longest);
    answer.normal = projector.col(longest).normalized();
    return answer;
  }
  answer.normal = v / distance;
  answer.dNormal = (projector - answer.normal * answer.normal.transpose()) / distance;
  return answer;
}

/// Gap of a plane figure that is the same on both sides of an axis, at distance r from the axis and height h
/// along it: its derivatives by (r, h).
struct ProfileGap {
  double gap = 0.0;
  Eigen::Vector2d normal = Eigen::Vector2d::UnitY();
  Eigen::Matrix2d dNormal = Eigen::Matrix2d::Zero();
};

/// Distance to a point less a radius; straight ahead in the point itself.
ProfileGap circleProfile(const Eigen::Vector2d& fromCenter, double radius) {
  ProfileGap answer;
  const double distance = fromCenter.norm();
  answer.gap = distance - radius;
  if (distance == 0.0) return answer;
  answer.normal = fromCenter / distance;
  answer.dNormal = (Eigen::Matrix2d::Identity() - answer.normal * answer.normal.transpose()) / distance;
  return answer;
}

/// A wedge with its tip at the origin that opens downwards: the sharp wedge with its tip in the centre of the
/// rounding, grown by the radius.
ProfileGap wedgeProfile(double r, double h, double halfAngle, double radius) {
  const Eigen::Vector2d fromCenter(r, h + radius);
  const Eigen::Vector2d downTheFlank(std::sin(halfAngle), -std::cos(halfAngle));
  if (fromCenter.dot(downTheFlank) <= 0.0) return circleProfile(fromCenter, radius);
  ProfileGap answer;
  answer.normal = {std::cos(halfAngle), std::sin(halfAngle)};
  answer.gap = fromCenter.dot(answer.normal) - radius;
  return answer;
}

/// A point by its distance r from an axis and its height h along it.
struct AxisPlace {
  Eigen::Vector3d axis;    ///< unit
  Eigen::Vector3d radial;  ///< unit, away from the axis
  double r, h;
};

AxisPlace placeAbout(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, const Eigen::Vector3d& x) {
  AxisPlace place;
  place.axis = axis.normalized();
  place.h = (x - origin).dot(place.axis);
  const Eigen::Vector3d across = x - origin - place.h * place.axis;
  place.r = across.norm();
  place.radial = place.r > 0.0 ? Eigen::Vector3d(across / place.r) : place.axis.unitOrthogonal();
  return place;
}

GapQuery lifted(const ProfileGap& profile, const Eigen::Vector3d& radial, const Eigen::Vector3d& axis) {
  Eigen::Matrix<double, 3, 2> frame;
  frame << radial, axis;
  return {profile.gap, frame * profile.normal, frame * profile.dNormal * frame.transpose()};
}

/// The profile turned about the axis: its circles add the curvature n_r / r, on the axis the limit ∂n_r/∂r.
GapQuery turned(const ProfileGap& profile, const AxisPlace& place) {
  GapQuery answer = lifted(profile, place.radial, place.axis);
  const Eigen::Vector3d around = place.axis.cross(place.radial);
  const double curvature = place.r > 0.0 ? profile.normal(0) / place.r : profile.dNormal(0, 0);
  answer.dNormal += curvature * around * around.transpose();
  return answer;
}

}  // namespace

GapQuery Plane::query(const Eigen::Vector3d& x) const {
  GapQuery answer;
  answer.normal = normal.normalized();
  answer.gap = (x - origin).dot(answer.normal);
  return answer;
}

GapQuery Cylinder::query(const Eigen::Vector3d& x) const {
  const Eigen::Vector3d a = axis.normalized();
  const Eigen::Matrix3d projector = Eigen::Matrix3d::Identity() - a * a.transpose();
  return roundGap(projector * (x - center), projector, radius);
}

GapQuery Sphere::query(const Eigen::Vector3d& x) const {
  return roundGap(x - center, Eigen::Matrix3d::Identity(), radius);
}

GapQuery Edge::query(const Eigen::Vector3d& x) const {
  const Eigen::Vector3d front = direction.normalized();
  const Eigen::Vector3d across = along.cross(front).normalized();
  const double s = (x - tip).dot(across);
  const ProfileGap profile = wedgeProfile(std::abs(s), (x - tip).dot(front), halfAngle, radius);
  return lifted(profile, s < 0.0 ? Eigen::Vector3d(-across) : across, front);
}

GapQuery Cone::query(const Eigen::Vector3d& x) const {
  const AxisPlace place = placeAbout(tip, direction, x);
  return turned(wedgeProfile(place.r, place.h, halfAngle, radius), place);
}

GapQuery Torus::query(const Eigen::Vector3d& x) const {
  const AxisPlace place = placeAbout(center, axis, x);
  return turned(circleProfile({place.r - radius, place.h}, tubeRadius), place);
}

GapQuery RoundedBox::query(const Eigen::Vector3d& x) const {
  const Eigen::Vector3d local = axes.transpose() * (x - center);
  const Eigen::Vector3d side = local.unaryExpr([](double v) { return v < 0.0 ? -1.0 : 1.0; });
  const Eigen::Vector3d beyond = local.cwiseAbs() - (0.5 * size.array() - radius).matrix();  // the core box
  GapQuery answer;
  if (Eigen::Index nearest = 0; beyond.maxCoeff(&nearest) <= 0.0) {
    answer.gap = beyond(nearest) - radius;
    answer.normal = side(nearest) * axes.col(nearest);
    return answer;
  }
  const Eigen::Vector3d isBeyond = (beyond.array() > 0.0).cast<double>();
  return roundGap(axes * beyond.cwiseMax(0.0).cwiseProduct(side),
                  axes * isBeyond.asDiagonal() * axes.transpose(), radius);
}

}  // namespace burnish
