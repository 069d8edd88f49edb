#include "engine/analysis/simulation.h"

#include <algorithm>
#include <utility>

#include "engine/analysis/residual_scales.h"

namespace burnish {

template <int Dim>
Simulation<Dim>::Simulation(const Scene& scene, std::unique_ptr<Model<Dim>> itsModel, SteppingState start)
    : model(std::move(itsModel)),
      terms(model->terms()),
      newton(terms, model->prescribed(), residualScales(*model), scene.solver.newton),
      stepping(
          newton, terms, [this](double t) { return model->target(t); }, scene.solver.stepping,
          std::move(start)),
      projection(model->quadrature()),
      recorder(scene, *model, projection) {}

template <int Dim>
typename Simulation<Dim>::Forces Simulation<Dim>::evaluateHere() {
  const auto& state = stepping.state();
  Forces forces{{}, Eigen::VectorXd::Zero(model->numUnknowns()), true};
  for (Term* term : terms) {
    Eigen::VectorXd force = Eigen::VectorXd::Zero(model->numUnknowns());
    Assembly out{force};
    if (!term->evaluate(state.time, state.x, out)) forces.admissible = false;
    forces.total += force;
    if (term == terms.front()) forces.bulk = std::move(force);
  }
  return forces;
}

template <int Dim>
void Simulation<Dim>::record() {
  Eigen::VectorXd total = Eigen::VectorXd::Zero(model->numUnknowns());
  for (const Eigen::VectorXd& force : newton.forces()) total += force;
  recorder.update({stepping.state().time, stepping.state().x, newton.forces().front()}, total,
                  {newton.unstableDirections(), model->stabilisedShare(newton.forces())});
}

template <int Dim>
std::vector<ToolPose> Simulation<Dim>::toolPoses() const {
  const SteppingState& state = stepping.state();
  std::vector<ToolPose> poses;
  for (const auto& tool : model->tools()) poses.push_back(tool->pose(std::max(0.0, state.time), state.x));
  return poses;
}

template struct Simulation<2>;
template struct Simulation<3>;

}  // namespace burnish
