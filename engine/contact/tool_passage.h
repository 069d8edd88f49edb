#pragma once
#include <Eigen/Dense>

#include "engine/core/state_archive.h"
#include "engine/tools/tool.h"

namespace burnish::inline contact {

/// Watches that the points of a face do not go through a tool: where they are too deep inside, or have gone
/// through a thin part of it since the accepted state, the gap at their place tells nothing any more.
class ToolPassage {
 public:
  /// The tool must outlive the object.
  explicit ToolPassage(const Tool& tool);

  /// Takes in the points of a state, one column each. gap: of a point, by its number. False if a point is too
  /// deep or has gone through.
  template <class Gap>
  [[nodiscard]] bool admits(const ToolPose& pose, const Eigen::MatrixXd& positions, const Gap& gap) {
    trial_ = inTool(pose, positions);
    for (Eigen::Index q = 0; q < positions.cols(); ++q)
      if (gap(q) < -deepest_) return false;
    return !hasPassedThrough();
  }

  void accept() { accepted_ = trial_; }
  void archive(StateArchive& archive) { archive.field("points_in_tool", accepted_); }

 private:
  /// Positions in the tool's reference position, one after the other.
  Eigen::VectorXd inTool(const ToolPose& pose, const Eigen::MatrixXd& positions) const;

  /// Whether a point has gone through a thin part of the tool on its way from the accepted state, which the
  /// gap at the way's end does not tell.
  bool hasPassedThrough() const;

  const Tool& tool_;
  double deepest_;            ///< inside the tool that a point may be
  Eigen::VectorXd accepted_;  ///< in the accepted state; empty before the first
  Eigen::VectorXd trial_;     ///< in the last one; both empty for a tool of any depth
};

}  // namespace burnish::inline contact
