#include "engine/analysis/simulation.h"

#include <algorithm>
#include <utility>

#include "engine/analysis/mesh_hierarchy.h"
#include "engine/analysis/residual_scales.h"
#include "engine/analysis/travelling_increment.h"
#include "engine/solver/multigrid.h"

namespace burnish::inline analysis {

namespace {

/// From so many displacement components in space on multigrid takes less time than sparse factors.
constexpr int kMultigridIsFaster = 25'000;

}  // namespace

template <int Dim>
std::optional<Hierarchy> hierarchyFor(const LinearSolverOptions& options, const Model<Dim>& model,
                                      const Team& team) {
  constexpr int kCoarsest = 500;
  const bool isOfUse =
      Dim == 3 && hasMultigrid() && (model.numDisplacements() >= kMultigridIsFaster || !team.isAlone());
  if (options.name == "direct" || (options.name == "auto" && !isOfUse)) return std::nullopt;
  return makeHierarchy(model, MergeRule{}, kCoarsest);
}

template <int Dim>
std::vector<Projection<Dim>> projectionsOf(const Model<Dim>& model) {
  std::vector<Projection<Dim>> projections;
  for (const auto& body : model.bodies()) projections.emplace_back(body.body, *body.quadrature);
  return projections;
}

template <int Dim>
Simulation<Dim>::Simulation(const Scene& scene, std::unique_ptr<Model<Dim>> itsModel, SteppingState start,
                            const Team& team, std::optional<Division> division)
    : model(std::move(itsModel)),
      terms(model->terms()),
      newton(terms, model->prescribed(), residualScales(*model), scene.solver.newton,
             hierarchyFor(scene.solver.newton.linear, *model, team), team, std::move(division)),
      stepping(
          newton, terms, [this](double t) { return model->target(t); }, scene.solver.stepping,
          std::move(start),
          [travelling = TravellingIncrement<Dim>(*model)](double before, double to,
                                                          Eigen::VectorXd& increment) {
            travelling.move(before, to, increment);
          }),
      projections(projectionsOf(*model)),
      recorder(scene, *model, projections) {}

template <int Dim>
typename Simulation<Dim>::Forces Simulation<Dim>::evaluateHere() {
  const auto& state = stepping.state();
  Forces forces;
  std::vector<Eigen::VectorXd> ofTerms;
  for (Term* term : terms) {
    Eigen::VectorXd& force = ofTerms.emplace_back(Eigen::VectorXd::Zero(model->numUnknowns()));
    Assembly out{force};
    if (!term->evaluate(state.time, state.x, out)) forces.admissible = false;
  }
  forces.onSupports = model->forcesOnSupports(ofTerms);
  forces.bulk = model->bulkForces(ofTerms);
  return forces;
}

template <int Dim>
void Simulation<Dim>::record() {
  const Eigen::VectorXd bulk = model->bulkForces(newton.forces());
  recorder.update(
      {stepping.state().time, stepping.state().x, bulk}, model->forcesOnSupports(newton.forces()),
      {[this] { return newton.countUnstableDirections(); }, model->stabilisedShare(newton.forces())});
}

template <int Dim>
std::unique_ptr<Simulation<Dim>> letGo(const Scene& scene, Simulation<Dim>& before, const Team& team) {
  const SteppingState state = before.stepping.state();
  StateArchive saved;
  before.recorder.archive(saved);
  const auto division = team.isAlone() ? std::nullopt : std::optional(before.newton.system().division());
  auto next = std::make_unique<Simulation<Dim>>(scene, std::move(before.model), state, team, division);
  StateArchive restored(saved.values());
  next->recorder.archive(restored);
  return next;
}

template <int Dim>
std::vector<ToolPose> Simulation<Dim>::toolPoses() const {
  const SteppingState& state = stepping.state();
  std::vector<ToolPose> poses;
  for (const auto& tool : model->tools()) poses.push_back(tool->pose(std::max(0.0, state.time), state.x));
  return poses;
}

template std::vector<Projection<2>> projectionsOf(const Model<2>&);
template std::vector<Projection<3>> projectionsOf(const Model<3>&);
template std::optional<Hierarchy> hierarchyFor(const LinearSolverOptions&, const Model<2>&, const Team&);
template std::optional<Hierarchy> hierarchyFor(const LinearSolverOptions&, const Model<3>&, const Team&);
template std::unique_ptr<Simulation<2>> letGo(const Scene&, Simulation<2>&, const Team&);
template std::unique_ptr<Simulation<3>> letGo(const Scene&, Simulation<3>&, const Team&);
template struct Simulation<2>;
template struct Simulation<3>;

}  // namespace burnish::inline analysis
