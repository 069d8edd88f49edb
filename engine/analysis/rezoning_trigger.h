#pragma once
#include "engine/analysis/partner_places.h"
#include "engine/analysis/simulation.h"
#include "engine/core/state_archive.h"
#include "engine/scene/scene.h"

namespace burnish::inline analysis {

/// Decides when a body is remeshed: a tool or another body that it may touch has travelled far enough since the
/// last time, or its mesh is stretched or distorted too much.
class RezoningTrigger {
 public:
  /// body: its number. travel: of a tool, a length. initial: the simulation in which the run begins.
  RezoningTrigger(const RezoningOptions& options, std::size_t body, double travel,
                  const Simulation<2>& initial);

  /// Whether the last accepted state calls for a new mesh. Not where a face of the body crosses itself: what is
  /// there twice has no mesh.
  bool isDue(const Simulation<2>& simulation) const;

  /// Remeshing was tried in the current state. After a failure it is tried again after a quarter of the
  /// travel.
  void noteAttempt(const Simulation<2>& simulation, bool succeeded);

  /// Where the body's partners were when remeshing was tried last, or at the start.
  const PartnerPlaces& lastPlaces() const { return lastPlaces_; }

  void archive(StateArchive& archive);

 private:
  /// Largest travel of a tool or another body in contact pairs of the body since the last attempt.
  double travelSince(const Simulation<2>& simulation) const;

  std::size_t body_;
  double stretch_, quality_;  ///< limits, see the scene
  double travel_;
  PartnerPlaces lastPlaces_;
  double wait_;  ///< travel from there to the next attempt
  bool failedLast_ = false;
};

}  // namespace burnish::inline analysis
