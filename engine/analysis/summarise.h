#pragma once
#include "engine/analysis/run_summary.h"
#include "engine/analysis/simulation.h"
#include "engine/scene/scene.h"

namespace burnish::inline analysis {

/// Takes the residuals of an accepted step into the summary.
void addResiduals(RunSummary& summary, const NewtonReport& report);

/// Adds what a simulation has cost; to be called once for every simulation of a run.
template <int Dim>
void addCosts(RunSummary& summary, Simulation<Dim>& simulation);

/// Tells how several ranks have divided the work.
template <int Dim>
void describeRanks(RunSummary& summary, const Simulation<Dim>& simulation, const Team& team);

/// Equations of the linear systems: the unknowns that nothing prescribes.
template <int Dim>
int numEquations(const Model<Dim>& model);

/// Fills in the size of the problem, the steps and iterations, and what is known of the last state.
/// summary: with the approach, whether the run is completed, and steps from t = 0 on.
template <int Dim>
void describeEnd(RunSummary& summary, const Simulation<Dim>& simulation);

}  // namespace burnish::inline analysis
