#include "engine/analysis/stage.h"

#include <utility>

namespace burnish {

template <int Dim>
Stage<Dim>::Stage(const Scene& scene, std::unique_ptr<Model<Dim>> itsModel, SteppingState start)
    : model(std::move(itsModel)),
      terms(model->terms()),
      newton(terms, model->prescribed(), model->residualScales(), scene.solver.newton),
      stepping(
          newton, terms, [this](double t) { return model->target(t); }, scene.solver.stepping,
          std::move(start)),
      projection(model->quadrature()),
      recorder(scene, *model, projection) {}

template <int Dim>
typename Stage<Dim>::Forces Stage<Dim>::evaluateHere() {
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
void Stage<Dim>::record() {
  Eigen::VectorXd total = Eigen::VectorXd::Zero(model->numUnknowns());
  for (const Eigen::VectorXd& force : newton.forces()) total += force;
  recorder.update({stepping.state().time, stepping.state().x, newton.forces().front()}, total,
                  {newton.unstableDirections(), model->stabilisedShare(newton.forces())});
}

template struct Stage<2>;
template struct Stage<3>;

}  // namespace burnish
