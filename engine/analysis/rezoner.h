#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/carry_over.h"
#include "engine/analysis/choose_mesh.h"
#include "engine/analysis/rezoning_trigger.h"
#include "engine/analysis/settle.h"
#include "engine/analysis/simulation.h"
#include "engine/core/state_archive.h"
#include "engine/results/result.h"
#include "engine/results/run_account.h"

namespace burnish {

/// Remeshes a plane or axisymmetric body of one patch while a tool or another body moves along it, so that its
/// surface is always resolved where that is. Other bodies keep their meshes. `RezoningTrigger` decides when, `chooseMesh` how; `CarryOver` takes the
/// state to the new mesh, where `settle` brings it into equilibrium.
class Rezoner {
 public:
  /// The scene, which asks for rezoning, must outlive the object. initial: the simulation in which the run
  /// begins.
  Rezoner(const Scene& scene, const Simulation<2>& initial);

  /// Whether the last accepted state calls for a new mesh.
  bool isDue(const Simulation<2>& simulation) const { return trigger_.isDue(simulation); }

  /// The simulation that goes on from the last accepted state of this one, in equilibrium on a new mesh.
  /// Nothing if there is no sound mesh or no equilibrium on it: the run then goes on as it is, and tries
  /// again later.
  std::unique_ptr<Simulation<2>> rezone(Simulation<2>& simulation);

  const std::vector<RezoningRecord>& records() const { return records_; }

  /// How the last one that was tried came into equilibrium, or did not.
  const NewtonReport& lastReport() const { return lastReport_; }

  int numFailures() const { return numFailures_; }

  /// Why the last one failed that did since the run was begun or resumed; empty without.
  const std::string& lastFailure() const { return lastFailure_; }

  /// The meshes of a frame, control points of the remeshed body where the material of the mesh's parameters was
  /// at the start of the run, approximately; nothing before the first rezoning. displacement: of the present
  /// reference, becomes the one from the start of the run.
  std::optional<MeshRecord> frameMesh(const Simulation<2>& simulation, Eigen::MatrixXd& displacement) const;

  void archive(StateArchive& archive);

  /// After restoring: the simulation of the last rezoning, as it began; null if there was none.
  std::unique_ptr<Simulation<2>> restoredSimulation() const;

 private:
  /// The same as `rezone`; throws `Error` where the new body cannot be used.
  std::unique_ptr<Simulation<2>> attempt(Simulation<2>& simulation);

  /// A simulation on a new mesh, and how it came into equilibrium.
  struct Settled {
    std::unique_ptr<Simulation<2>> simulation;
    Settlement settlement;
  };
  Settled settledOn(const CarryOver& carried) const;

  RezoningRecord recordOf(const Simulation<2>& before, const Settled& after, const Remeshing& mesh) const;
  void archiveRecords(StateArchive& archive);
  void fail(const Simulation<2>& simulation, const std::string& why);

  const ModelBody<2>& bodyOf(const Simulation<2>& simulation) const {
    return simulation.model->bodies()[choice_.body];
  }

  const Scene& scene_;
  MeshChoice choice_;
  RezoningTrigger trigger_;
  double volume_;  ///< stress-free, of the body
  std::vector<RezoningRecord> records_;
  NewtonReport lastReport_;
  int numFailures_ = 0;
  std::string lastFailure_;
  std::optional<RezonedBody> body_;  ///< as the present simulation began
  Eigen::MatrixXd origin_;           ///< 2 x nodes of the body: see `frameMesh`
};

}  // namespace burnish
