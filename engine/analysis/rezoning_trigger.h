#pragma once
#include <vector>

#include "engine/analysis/simulation.h"
#include "engine/core/state_archive.h"
#include "engine/scene/scene.h"
#include "engine/tools/tool.h"

namespace burnish {

/// Decides when a body is remeshed: a tool has travelled far enough since the last time, or the mesh is
/// stretched or distorted too much.
class RezoningTrigger {
 public:
  /// travel: of a tool, a length. initial: the simulation in which the run begins.
  RezoningTrigger(const RezoningOptions& options, double travel, const Simulation<2>& initial);

  /// Whether the last accepted state calls for a new mesh. Not where the face crosses itself: what is there
  /// twice has no mesh.
  bool isDue(const Simulation<2>& simulation) const;

  /// Remeshing was tried in the current state. After a failure it is tried again after a quarter of the
  /// travel.
  void noteAttempt(const Simulation<2>& simulation, bool succeeded);

  /// Poses of the tools when remeshing was tried last, or at the start.
  const std::vector<ToolPose>& lastPoses() const { return lastPoses_; }

  void archive(StateArchive& archive);

 private:
  /// Largest travel of a tool in contact pairs since the last attempt.
  double travelSince(const Simulation<2>& simulation) const;

  double stretch_, quality_;  ///< limits, see the scene
  double travel_;
  std::vector<ToolPose> lastPoses_;
  double wait_;  ///< travel from there to the next attempt
  bool failedLast_ = false;
};

}  // namespace burnish
