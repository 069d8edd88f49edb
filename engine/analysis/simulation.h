#pragma once
#include <memory>
#include <vector>

#include "engine/analysis/model.h"
#include "engine/analysis/recorder.h"
#include "engine/fields/projection.h"
#include "engine/solver/newton.h"
#include "engine/solver/stepping.h"
#include "engine/tools/tool.h"

namespace burnish::inline analysis {

/// The projections of a model, one per body.
template <int Dim>
std::vector<Projection<Dim>> projectionsOf(const Model<Dim>& model);

/// Nested spaces for linear solvers that use them; none for sparse factors. Several ranks have no other solver.
template <int Dim>
std::optional<Hierarchy> hierarchyFor(const LinearSolverOptions& options, const Model<Dim>& model,
                                      const Team& team);

/// A model with everything that solves and records it: what is replaced when the body is remeshed.
template <int Dim>
struct Simulation {
  /// Scene and team must outlive the simulation. division: of a model that ranks have divided before.
  Simulation(const Scene& scene, std::unique_ptr<Model<Dim>> model, SteppingState start,
             const Team& team = alone(), std::optional<Division> division = {});
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  struct Forces {
    Eigen::VectorXd bulk, onSupports;  ///< of the bodies; see `Model::forcesOnSupports`
    bool admissible = true;
  };

  /// Evaluates the terms at the current state without a step.
  Forces evaluateHere();

  /// Hands the state that a step has just reached to the recorder.
  void record();

  /// Poses of the tools in the current state; before t = 0, where lifted tools come down, those at t = 0.
  std::vector<ToolPose> toolPoses() const;

  std::unique_ptr<Model<Dim>> model;
  std::vector<Term*> terms;
  Newton newton;
  Stepping stepping;
  std::vector<Projection<Dim>> projections;  ///< one per body
  Recorder<Dim> recorder;
};

/// A simulation that goes on from the state of another one with its model, of which `Model::releaseBehind` has
/// freed or prescribed unknowns.
template <int Dim>
std::unique_ptr<Simulation<Dim>> letGo(const Scene& scene, Simulation<Dim>& before, const Team& team);

}  // namespace burnish::inline analysis
