#include "engine/tools/tool.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace burnish {

std::vector<int> Tool::freeUnknowns() const {
  std::vector<int> numbers;
  std::copy_if(unknowns.begin(), unknowns.end(), std::back_inserter(numbers), [](int i) { return i >= 0; });
  return numbers;
}

ToolPose Tool::pose(double t) const {
  const double moved = std::max(t, 0.0);
  const auto value = [&](std::size_t dof) { return motion[dof] ? motion[dof](moved) : 0.0; };
  ToolPose pose{{value(0), value(1), value(2)}, value(kTurn)};
  if (t < 0.0 && approachTime > 0.0) pose.displacement += -t / approachTime * lift;
  return pose;
}

ToolPose Tool::pose(double t, const Eigen::VectorXd& x) const {
  ToolPose result = pose(t);
  for (std::size_t dof = 0; dof < kTurn; ++dof)
    if (isFree(dof)) result.displacement(static_cast<Eigen::Index>(dof)) = x(unknowns[dof]);
  if (isFree(kTurn)) result.angle = x(unknowns[kTurn]) / turnLength;
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
  return {own.gap, R * own.normal, R * own.dNormal * R.transpose()};
}

ToolGap Tool::queryWithDofs(const ToolPose& pose, const Eigen::Vector3d& x) const {
  ToolGap answer;
  answer.point = query(pose, x);
  const auto& [gap, n, H] = answer.point;
  const Eigen::Vector3d arm = axis / turnLength;
  Eigen::Matrix<double, 3, kToolDofs> velocity;  // of the tool's matter at x, per degree of freedom
  velocity << Eigen::Matrix3d::Identity(), arm.cross(x - pose.displacement - pivot);
  answer.dDofs = -velocity.transpose() * n;
  answer.dNormal = -H * velocity;
  answer.dNormal.col(kTurn) += arm.cross(n);
  answer.d2 = -velocity.transpose() * answer.dNormal;
  // A displacement moves the pivot, and with it the velocity of a turn.
  answer.d2.row(kTurn).head<3>() -= arm.cross(n).transpose();
  return answer;
}

}  // namespace burnish
