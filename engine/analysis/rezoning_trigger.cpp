#include "engine/analysis/rezoning_trigger.h"

#include <algorithm>

#include "engine/analysis/deformed_patch.h"
#include "engine/rezoning/remesh.h"

namespace burnish::inline analysis {

RezoningTrigger::RezoningTrigger(const RezoningOptions& options, std::size_t body, double travel,
                                 const Simulation<2>& initial)
    : body_(body),
      stretch_(options.stretch),
      quality_(options.quality),
      travel_(travel),
      lastPlaces_(partnerPlaces(initial, initial.model->bodies()[body])),
      wait_(travel) {}

double RezoningTrigger::travelSince(const Simulation<2>& simulation) const {
  const Model<2>& model = *simulation.model;
  const ModelBody<2>& body = model.bodies()[body_];
  const PartnerPlaces places = partnerPlaces(simulation, body);
  double travel = 0.0;
  for (const auto& pair : model.contacts())
    if (&model.bodyOf(pair.place) == &body && !model.hasLeft(pair.tool))
      travel = std::max(travel, lastPlaces_.travelOfTool(pair.tool, places).norm());
  for (std::size_t k = 0; k < model.pairs().size(); ++k)
    travel = std::max(travel, lastPlaces_.travelOfPair(k, places).norm());
  return travel;
}

bool RezoningTrigger::isDue(const Simulation<2>& simulation) const {
  if (simulation.recorder.current().bodyCrossesItself(body_)) return false;
  constexpr double kAlmost = 1.0 - 1e-9;  // steps that land on the travel, but for rounding
  if (travelSince(simulation) >= kAlmost * wait_) return true;
  if (failedLast_) return false;
  const ModelBody<2>& body = simulation.model->bodies()[body_];
  const auto& x = simulation.stepping.state().x;
  if (body.bulk->largestStretch(x) > stretch_) return true;
  return quality_ > 0.0 && meshQuality(deformedPatch(body.body, x)) < quality_;
}

void RezoningTrigger::noteAttempt(const Simulation<2>& simulation, bool succeeded) {
  constexpr double kShareToNextAttempt = 0.25;
  const ModelBody<2>& body = simulation.model->bodies()[body_];
  lastPlaces_ = succeeded ? partnerPlacesOnNewMesh(simulation, body) : partnerPlaces(simulation, body);
  failedLast_ = !succeeded;
  wait_ = failedLast_ ? kShareToNextAttempt * travel_ : travel_;
}

void RezoningTrigger::archive(StateArchive& archive) {
  lastPlaces_.archive(archive);
  archive.field("wait", wait_);
  int failedLast = failedLast_ ? 1 : 0;
  archive.field("failed_last", failedLast);
  failedLast_ = failedLast == 1;
}

}  // namespace burnish::inline analysis
