#include "engine/tools/tool.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace burnish::inline tools {
namespace {

Eigen::Matrix3d crossWith(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

}  // namespace

TurnByVector turned(const Eigen::Vector3d& theta) {
  constexpr double kSmall = 1e-4;  // below it the next terms of the series are lost in rounding
  const double squared = theta.squaredNorm(), angle = std::sqrt(squared);
  const bool isSmall = angle < kSmall;
  const double sine = isSmall ? 1.0 - squared / 6.0 : std::sin(angle) / angle;
  const double half = isSmall ? 0.5 - squared / 24.0 : (1.0 - std::cos(angle)) / squared;
  const double third = isSmall ? 1.0 / 6.0 - squared / 120.0 : (1.0 - sine) / squared;
  const Eigen::Matrix3d T = crossWith(theta), T2 = T * T;
  return {Eigen::Matrix3d::Identity() + sine * T + half * T2,
          Eigen::Matrix3d::Identity() + half * T + third * T2};
}

std::vector<int> Tool::freeUnknowns() const {
  std::vector<int> numbers;
  std::copy_if(unknowns.begin(), unknowns.end(), std::back_inserter(numbers), [](int i) { return i >= 0; });
  return numbers;
}

ToolPose Tool::pose(double t) const {
  const double moved = std::max(t, 0.0);
  const auto value = [&](std::size_t dof) { return motion[dof] ? motion[dof](moved) : 0.0; };
  ToolPose pose{.displacement = {value(0), value(1), value(2)}, .angle = value(kTurn)};
  if (followsSurface()) pose.normal = normal(moved);
  if (t < 0.0 && approachTime > 0.0) pose.displacement += -t / approachTime * lift;
  return pose;
}

ToolPose Tool::pose(double t, const Eigen::VectorXd& x) const {
  ToolPose result = pose(t);
  if (followsSurface()) {
    result.alongNormal = x(unknowns[kNormal]);
    result.displacement += result.alongNormal * result.normal;
  } else {
    for (std::size_t dof = 0; dof < kTurn; ++dof)
      if (isFree(dof)) result.displacement(static_cast<Eigen::Index>(dof)) = x(unknowns[dof]);
  }
  if (isFree(kTurn)) result.angle = x(unknowns[kTurn]) / turnLength;
  if (spins())
    for (std::size_t d = 0; d < kSpins; ++d)
      result.spin(static_cast<Eigen::Index>(d)) = x(unknowns[kSpin + d]) / turnLength;
  return result;
}

Eigen::Vector3d Tool::toReference(const ToolPose& pose, const Eigen::Vector3d& x) const {
  if (pose.angle == 0.0) return x - pose.displacement;
  return Eigen::AngleAxisd(-pose.angle, axis) * (x - pose.displacement - pivot) + pivot;
}

GapQuery Tool::query(const ToolPose& pose, const Eigen::Vector3d& x) const {
  if (pose.angle == 0.0) return shape.query(x - pose.displacement);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(pose.angle, axis).toRotationMatrix();
  const GapQuery own = shape.query(R.transpose() * (x - pose.displacement - pivot) + pivot);
  return {own.gap, R * own.normal, R * own.dNormal * R.transpose(), own.part};
}

ToolGap Tool::queryWithDofs(const ToolPose& pose, const Eigen::Vector3d& x) const {
  ToolGap answer;
  answer.point = query(pose, x);
  const Eigen::Vector3d& n = answer.point.normal;
  const Eigen::Matrix3d& H = answer.point.dNormal;
  const Eigen::Vector3d arm = axis / turnLength;
  Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();
  if (followsSurface()) directions.col(kNormal) = pose.normal;
  Eigen::Matrix<double, 3, kToolDofs> velocity;  // of the tool's matter at x, per degree of freedom
  velocity << directions, arm.cross(x - pose.displacement - pivot);
  answer.dDofs = -velocity.transpose() * n;
  answer.dNormal = -H * velocity;
  answer.dNormal.col(kTurn) += arm.cross(n);
  answer.d2 = -velocity.transpose() * answer.dNormal;
  // A displacement moves the pivot, and with it the velocity of a turn.
  answer.d2.row(kTurn).head<3>() -= arm.cross(n).transpose() * directions;
  return answer;
}

}  // namespace burnish::inline tools
