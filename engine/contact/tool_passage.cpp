#include "engine/contact/tool_passage.h"

#include <algorithm>
#include <cmath>

namespace burnish::inline contact {
namespace {

/// A point that is deeper inside a round tool than this share of its radius is about to leave it on the far
/// side, where the nearest surface would pull it on: such a state is not admissible.
constexpr double kDeepestShare = 0.5;

/// The way of a point is looked at in pieces of at least this share of that depth.
constexpr double kShortestShare = 0.5;

}  // namespace

ToolPassage::ToolPassage(const Tool& tool)
    : tool_(tool), deepest_(kDeepestShare * tool.shape.halfThickness()) {}

Eigen::VectorXd ToolPassage::inTool(const ToolPose& pose, const Eigen::MatrixXd& positions) const {
  if (std::isinf(deepest_)) return {};
  Eigen::VectorXd points(3 * positions.cols());
  for (Eigen::Index q = 0; q < positions.cols(); ++q) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x.head(positions.rows()) = positions.col(q);
    points.segment<3>(3 * q) = tool_.toReference(pose, x);
  }
  return points;
}

bool ToolPassage::hasPassedThrough() const {
  for (Eigen::Index q = 0; 3 * q < accepted_.size(); ++q) {
    const Eigen::Vector3d from = accepted_.segment<3>(3 * q), to = trial_.segment<3>(3 * q);
    const double way = (to - from).norm();
    // Gaps change by no more than the way. A short one that begins and ends near the surface stays there.
    for (double done = 0.0; way > deepest_ && done < way;) {
      const double gap = tool_.shape.query(from + done / way * (to - from)).gap;
      if (gap < -deepest_) return true;
      done += std::max(gap + deepest_, kShortestShare * deepest_);
    }
  }
  return false;
}

}  // namespace burnish::inline contact
