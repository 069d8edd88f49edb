#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/build_model.h"
#include "engine/analysis/settle.h"
#include "engine/analysis/simulation.h"
#include "engine/core/state_archive.h"
#include "engine/results/run_account.h"

namespace burnish::inline analysis {

/// Gives a term what another one has been through.
void copyHistory(Term& from, Term& to);

/// How steps go on in another model of the same scene, in the state that it begins with but for tools, which are where
/// they were and carry what they carried: at the same time, with smaller steps and no last increment.
template <int Dim>
SteppingState continuedSteps(const Simulation<Dim>& before, const Model<Dim>& next);

/// Of all unknowns of a model those of its tools.
template <int Dim>
auto toolUnknowns(const Model<Dim>& model, auto& x) {
  return x.segment(model.numDisplacements(), model.numForces() - model.numDisplacements());
}

/// What is the same wherever a body is meshed anew and whatever makes its meshes: the way into equilibrium, and the
/// account of it.
template <int Dim>
class MeshRenewal {
 public:
  const std::vector<RezoningRecord>& records() const { return records_; }

  /// How the last one that was tried came into equilibrium, or did not.
  const NewtonReport& lastReport() const { return lastReport_; }

  int numFailures() const { return numFailures_; }

  /// Why the last one failed that did since the run was begun or resumed; empty without.
  const std::string& lastFailure() const { return lastFailure_; }

  /// After restoring: the simulation of the last rezoning, as it began; null if there was none.
  std::unique_ptr<Simulation<Dim>> restoredSimulation() const;

 protected:
  using Next = std::unique_ptr<Simulation<Dim>>;

  /// body: its number. Team and scene, which asks for rezoning, must outlive the object. initial: the simulation in which
  /// the run begins. What follows is to be called by all ranks of the team.
  MeshRenewal(const Scene& scene, std::size_t body, const Simulation<Dim>& initial, const Team& team);

  /// What `attempt` answers, in the current state as a resumed run has it; null, with the reason noted, where that
  /// cannot be evaluated or `attempt` throws `Error`.
  Next tried(Simulation<Dim>& simulation, const std::function<Next()>& attempt);

  /// What a new mesh is like.
  struct MeshTraits {
    double boundaryError, quality, smallestSpan;  ///< see `RezoningRecord`
  };

  /// The simulation that goes on with the body on its new mesh, in equilibrium; null, with the reason noted, if that
  /// is not found. startOf: the state in which a model of that body begins, whose terms it gives their histories.
  Next continuedOn(const Simulation<Dim>& before, RezonedBody<Dim> body,
                   const std::function<SteppingState(const Model<Dim>&)>& startOf, const MeshTraits& mesh);

  void fail(const Simulation<Dim>& simulation, const std::string& why);

  const ModelBody<Dim>& bodyOf(const Simulation<Dim>& simulation) const {
    return simulation.model->bodies()[number_];
  }

  const Scene& scene() const { return scene_; }
  std::size_t number() const { return number_; }

  void archive(StateArchive& archive);

 private:
  /// A simulation on a new mesh, and how it came into equilibrium.
  struct Settled {
    Next simulation;
    Settlement settlement;
  };
  Settled settledOn(const RezonedBody<Dim>& body,
                    const std::function<SteppingState(const Model<Dim>&)>& startOf) const;
  RezoningRecord recordOf(const Simulation<Dim>& before, const Settled& after, const MeshTraits& mesh) const;
  void archiveRecords(StateArchive& archive);

  const Scene& scene_;
  std::size_t number_;
  const Team& team_;
  double volume_;  ///< stress-free, of the body
  std::vector<RezoningRecord> records_;
  NewtonReport lastReport_;
  int numFailures_ = 0;
  std::string lastFailure_;
  std::optional<RezonedBody<Dim>> body_;  ///< as the present simulation began
};

}  // namespace burnish::inline analysis
