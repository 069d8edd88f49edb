#include "engine/tools/profile_gap.h"

#include <cmath>

namespace burnish::inline tools {

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

ProfileGap circleProfile(const Eigen::Vector2d& fromCenter, double radius) {
  ProfileGap answer;
  const double distance = fromCenter.norm();
  answer.gap = distance - radius;
  if (distance == 0.0) return answer;
  answer.normal = fromCenter / distance;
  answer.dNormal = (Eigen::Matrix2d::Identity() - answer.normal * answer.normal.transpose()) / distance;
  return answer;
}

ProfileGap wedgeProfile(double r, double h, double halfAngle, double radius) {
  const Eigen::Vector2d fromCenter(r, h + radius);
  const Eigen::Vector2d downTheFlank(std::sin(halfAngle), -std::cos(halfAngle));
  if (fromCenter.dot(downTheFlank) <= 0.0) return circleProfile(fromCenter, radius);
  ProfileGap answer;
  answer.normal = {std::cos(halfAngle), std::sin(halfAngle)};
  answer.gap = fromCenter.dot(answer.normal) - radius;
  answer.part = 1;
  return answer;
}

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
  return {profile.gap, frame * profile.normal, frame * profile.dNormal * frame.transpose(), profile.part};
}

GapQuery turned(const ProfileGap& profile, const AxisPlace& place) {
  GapQuery answer = lifted(profile, place.radial, place.axis);
  const Eigen::Vector3d around = place.axis.cross(place.radial);
  const double curvature = place.r > 0.0 ? profile.normal(0) / place.r : profile.dNormal(0, 0);
  answer.dNormal += curvature * around * around.transpose();
  return answer;
}

}  // namespace burnish::inline tools
