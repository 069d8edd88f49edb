#include "engine/analysis/rezoning_trigger.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/analysis/deformed_patch.h"
#include "engine/rezoning/remesh.h"

namespace burnish {

RezoningTrigger::RezoningTrigger(const RezoningOptions& options, double travel, const Simulation<2>& initial)
    : stretch_(options.stretch),
      quality_(options.quality),
      travel_(travel),
      lastPoses_(initial.toolPoses()),
      wait_(travel) {}

double RezoningTrigger::travelSince(const Simulation<2>& simulation) const {
  const auto poses = simulation.toolPoses();
  double travel = 0.0;
  for (const auto& pair : simulation.model->contacts())
    travel = std::max(travel, (poses[pair.tool].displacement - lastPoses_[pair.tool].displacement).norm());
  return travel;
}

bool RezoningTrigger::isDue(const Simulation<2>& simulation) const {
  if (simulation.recorder.crossesItself()) return false;
  constexpr double kAlmost = 1.0 - 1e-9;  // steps that land on the travel, but for rounding
  if (travelSince(simulation) >= kAlmost * wait_) return true;
  if (failedLast_) return false;
  const Model<2>& model = *simulation.model;
  const auto& x = simulation.stepping.state().x;
  if (model.bodies().front().bulk->largestStretch(x) > stretch_) return true;
  return quality_ > 0.0 && meshQuality(deformedPatch(model.body().patches.front(), x)) < quality_;
}

void RezoningTrigger::noteAttempt(const Simulation<2>& simulation, bool succeeded) {
  constexpr double kShareToNextAttempt = 0.25;
  lastPoses_ = simulation.toolPoses();
  failedLast_ = !succeeded;
  wait_ = failedLast_ ? kShareToNextAttempt * travel_ : travel_;
}

void RezoningTrigger::archive(StateArchive& archive) {
  for (std::size_t k = 0; k < lastPoses_.size(); ++k) {
    archive.field(fmt::format("tool{}_displacement", k), lastPoses_[k].displacement);
    archive.field(fmt::format("tool{}_angle", k), lastPoses_[k].angle);
  }
  archive.field("wait", wait_);
  int failedLast = failedLast_ ? 1 : 0;
  archive.field("failed_last", failedLast);
  failedLast_ = failedLast == 1;
}

}  // namespace burnish
