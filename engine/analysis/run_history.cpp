#include "engine/analysis/run_history.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/analysis/face_crossing.h"
#include "engine/analysis/initial_state.h"
#include "engine/core/stopwatch.h"
#include "engine/fields/body_fields.h"

namespace burnish::inline analysis {
namespace {

/// The field of a material law that has columns of its own in the history, zero for laws without it.
constexpr const char* kPlasticStrain = "plastic_strain";

template <int Dim>
std::vector<SpanExtremes<Dim>> extremesOf(const Model<Dim>& model) {
  std::vector<SpanExtremes<Dim>> extremes;
  for (const auto& body : model.bodies()) extremes.emplace_back(body.body);
  return extremes;
}

}  // namespace

template <int Dim>
RunHistory<Dim>::RunHistory(const Scene& scene, const Model<Dim>& model,
                            const std::vector<Projection<Dim>>& projections)
    : model_(model),
      startsWithStress_(hasInitialState(scene)),
      projections_(projections),
      extremes_(extremesOf(model)),
      measures_(scene, model, projections),
      reactions_(scene, model),
      columns_(historyColumns(scene, model, reactions_.columns(), measures_.columns())) {
  current_.toolPoses.resize(model.tools().size());
  if (model.bodies().size() > 1) current_.bodies.resize(model.bodies().size());
  current_.toolForces.resize(model.tools().size(), Eigen::Vector3d::Zero());
  current_.toolMoments = current_.toolForces;
  current_.toolTouches.resize(model.tools().size());
  current_.pairs.resize(model.pairs().size());
  current_.reactions = reactions_.values();
  current_.measured.resize(measures_.columns().size());
}

template <int Dim>
std::vector<std::string> RunHistory<Dim>::columns() const {
  std::vector<std::string> names;
  for (const HistoryColumn& column : columns_) names.push_back(column.name);
  return names;
}

template <int Dim>
std::vector<double> RunHistory<Dim>::row(int step, int newtonIterations) const {
  const HistoryRow row{current_, step, newtonIterations};
  std::vector<double> values;
  for (const HistoryColumn& column : columns_) values.push_back(column.value(row));
  return values;
}

template <int Dim>
Eigen::VectorXd RunHistory<Dim>::loadForces() const {
  Eigen::VectorXd sum;
  const auto add = [&sum](const LoadTerm& load) {
    sum = sum.size() == 0 ? load.nodalForces() : Eigen::VectorXd(sum + load.nodalForces());
  };
  for (const auto& load : model_.loads()) add(*load);
  for (const LeavingTool& leaving : model_.leavingTools()) add(*leaving.held);
  return sum;
}

/// The springs of penalties go with their tool.
template <int Dim>
void RunHistory<Dim>::noteReleased() {
  double kept = 0.0;
  for (const auto& pair : model_.contacts()) kept += pair.term->state().energy;
  for (const auto& pair : model_.pairs()) kept += pair.term->state().energy;
  current_.externalWork -= std::exchange(current_.contactEnergy, kept) - kept;
  for (const LeavingTool& leaving : model_.leavingTools())
    if (leaving.hasLeft)
      current_.toolForces[leaving.tool] = current_.toolMoments[leaving.tool] = Eigen::Vector3d::Zero();
  loads_ = loadForces();
}

template <int Dim>
double RunHistory<Dim>::workIncrement(const Eigen::VectorXd& x, const Eigen::VectorXd& force,
                                      const Eigen::VectorXd& loads) const {
  if (x_.size() == 0) return 0.0;
  double work = 0.0;
  const Eigen::VectorXd increment = x - x_;
  for (Eigen::Index i = 0; i < model_.numDisplacements(); ++i)
    if (model_.supports().prescribed()[static_cast<std::size_t>(i)])
      work += 0.5 * (force_(i) + force(i)) * increment(i);
  if (loads_.size() > 0) work += 0.5 * (loads_ + loads).dot(increment.head(model_.numDisplacements()));
  return work;
}

template <int Dim>
void RunHistory<Dim>::addTools(const MeasuredState& state, StateQuantities& next) const {
  for (const auto& tool : model_.tools()) next.toolPoses.push_back(tool->pose(state.time, state.x));
  next.toolForces.assign(model_.tools().size(), Eigen::Vector3d::Zero());
  next.toolMoments = next.toolForces;
  next.toolTouches.resize(model_.tools().size());
  for (const auto& pair : model_.contacts()) {
    const ContactState& contact = pair.term->state();
    next.toolForces[pair.tool] += contact.reaction;
    next.toolMoments[pair.tool] += contact.moment;
    next.contactEnergy += contact.energy;
    next.activeControlPoints += contact.numActive();
    next.maxPenetration = std::max(next.maxPenetration, contact.largestPenetration());
    ToolTouch& touch = next.toolTouches[pair.tool];
    touch.area += contact.area;
    touch.friction += contact.frictionForce;
    touch.sticking += contact.sticking;
    touch.slipping += contact.slipping;
    touch.frictionWork += contact.frictionWork;
  }
}

template <int Dim>
void RunHistory<Dim>::addPairs(StateQuantities& next) const {
  for (const FacePair<Dim>& pair : model_.pairs()) {
    const ContactState& contact = pair.term->state();
    next.contactEnergy += contact.energy;
    next.activeControlPoints += contact.numActive();
    next.maxPenetration = std::max(next.maxPenetration, contact.largestPenetration());
    PairTouch touch;
    touch.force = contact.reaction;
    touch.pressed = contact.pressed;
    touch.friction = contact.frictionForce;
    touch.active = contact.numActive();
    touch.sticking = contact.sticking;
    touch.slipping = contact.slipping;
    touch.penetration = contact.largestPenetration();
    touch.frictionWork = contact.frictionWork;
    next.pairs.push_back(touch);
  }
}

template <int Dim>
void RunHistory<Dim>::addSelfContacts(StateQuantities& next) const {
  for (const auto& contact : model_.selfContacts()) {
    const ContactState& state = contact.term->state();
    next.selfActiveControlPoints += state.numActive();
    next.maxSelfPenetration = std::max(next.maxSelfPenetration, state.largestPenetration());
    next.selfForce += state.reaction.norm();
    next.selfTouch.friction += state.frictionForce;
    next.selfTouch.sticking += state.sticking;
    next.selfTouch.slipping += state.slipping;
    next.selfTouch.frictionWork += state.frictionWork;
  }
}

template <int Dim>
void RunHistory<Dim>::addBodies(StateQuantities& next) {
  next.minJ = std::numeric_limits<double>::infinity();
  bool flowed = false;
  for (std::size_t k = 0; k < model_.bodies().size(); ++k) {
    const BulkTerm<Dim>& bulk = *model_.bodies()[k].bulk;
    BodyQuantities body{bulk.summary().strainEnergy, bulk.plasticWork(), 0.0, bulk.summary().minJ, false};
    next.strainEnergy += body.strainEnergy;
    next.plasticWork += body.plasticWork;
    next.minJ = std::min(next.minJ, body.minJ);
    if (bulk.points().hasField(kPlasticStrain)) {
      const Eigen::VectorXd strain =
          bulk.portion().whole(bulk.points().field(kPlasticStrain), Receivers::All).row(0);
      body.maxPlasticStrain = strain.maxCoeff();
      next.maxPlasticStrain = std::max(next.maxPlasticStrain, body.maxPlasticStrain);
      const Stopwatch stopwatch(projectionSeconds_);
      const Extremes found = extremes_[k](projections_[k].project(strain).col(0));
      Extremes& all = next.projectedPlasticStrain;
      all = std::exchange(flowed, true) ? Extremes{std::min(all.min, found.min), std::max(all.max, found.max)}
                                        : found;
    }
    if (!next.bodies.empty()) next.bodies[k] = body;
  }
}

/// Work of the tools on the body since the last state.
template <int Dim>
double RunHistory<Dim>::toolWork(const StateQuantities& next) const {
  double work = 0.0;
  for (std::size_t k = 0; k < next.toolForces.size(); ++k) {
    const ToolPose &from = current_.toolPoses[k], &to = next.toolPoses[k];
    const double moment = model_.tools()[k]->axis.dot(current_.toolMoments[k] + next.toolMoments[k]);
    work -= 0.5 * (current_.toolForces[k] + next.toolForces[k]).dot(to.displacement - from.displacement) +
            0.5 * moment * (to.angle - from.angle);
  }
  return work;
}

/// Work of fitting faces into one another since the last state: that of the pressure on the way by which the
/// gap that is added to theirs has become smaller.
template <int Dim>
double RunHistory<Dim>::fittingWork(const StateQuantities& next) const {
  double work = 0.0;
  for (std::size_t k = 0; k < next.pairs.size(); ++k) {
    const GapRamp& fit = model_.pairs()[k].fit;
    work += 0.5 * (current_.pairs[k].pressed + next.pairs[k].pressed) *
            (fit.at(current_.time) - fit.at(next.time));
  }
  return work;
}

template <int Dim>
void RunHistory<Dim>::update(const MeasuredState& state, const Eigen::VectorXd& force,
                             double stabilisedShare) {
  const Eigen::VectorXd& x = state.x;
  Eigen::VectorXd loads = loadForces();
  StateQuantities next;
  next.time = state.time;
  next.rezonings = current_.rezonings;
  next.externalWork = current_.externalWork + workIncrement(x, force, loads);
  if (++states_ == 2 && loads_.size() > 0) suddenWork_ = 0.5 * loads_.dot((x - x_).head(loads_.size()));
  addTools(state, next);
  addPairs(next);
  addSelfContacts(next);
  // On a new mesh too: tools that carry a load move while a body comes into equilibrium on it.
  if (states_ > 1) next.externalWork += toolWork(next) + fittingWork(next);
  next.bodies.resize(current_.bodies.size());
  addBodies(next);
  next.stabilisedShare = stabilisedShare;
  next.stabilisationWork = current_.stabilisationWork;
  if (const auto* stabilisation = model_.stabilisation()) next.stabilisationWork += stabilisation->work();
  if (states_ == 1 && startsWithStress_) next.externalWork = next.energyFound();
  next.largestEnergy = std::max(current_.largestEnergy, std::abs(next.energyFound()));
  for (std::size_t k = 0; k < model_.bodies().size(); ++k) {
    const bool crosses = anyFaceCrossesItself(model_, model_.bodies()[k], x);
    next.crossesItself = next.crossesItself || crosses;
    if (!next.bodies.empty()) next.bodies[k].crossesItself = crosses;
  }
  next.measured = measures_.values(state);
  reactions_.update(state, force);
  next.reactions = reactions_.values();

  current_ = std::move(next);
  x_ = x;
  force_ = force;
  loads_ = std::move(loads);
  smallestJ_ = std::min(smallestJ_, current_.minJ);
  largestPenetration_ = std::max({largestPenetration_, current_.maxPenetration, current_.maxSelfPenetration});
  largestStabilisedShare_ = std::max(largestStabilisedShare_, current_.stabilisedShare);
}

template <int Dim>
Extremes RunHistory<Dim>::projectedVonMises() const {
  Extremes all{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < model_.bodies().size(); ++k) {
    const BulkTerm<Dim>& bulk = *model_.bodies()[k].bulk;
    const Eigen::MatrixXd mises =
        bulk.portion().whole(quadratureFields(bulk, "").at("von_mises").values, Receivers::All);
    const Extremes found = extremes_[k](projections_[k].project(mises.transpose()).col(0));
    all = {std::min(all.min, found.min), std::max(all.max, found.max)};
  }
  return all;
}

template <int Dim>
void RunHistory<Dim>::continueFrom(const RunHistory& before) {
  current_ = before.current_;
  smallestJ_ = before.smallestJ_;
  largestPenetration_ = before.largestPenetration_;
  largestStabilisedShare_ = before.largestStabilisedShare_;
  states_ = before.states_;
  suddenWork_ = before.suddenWork_;
  reactions_.continueFrom(before.reactions_);
  projectionSeconds_ = before.projectionSeconds_;
}

template <int Dim>
void RunHistory<Dim>::archive(StateArchive& archive) {
  archive.part("current", current_);
  archive.field("x", x_);
  archive.field("force", force_);
  archive.field("loads", loads_);
  archive.together("extremes", smallestJ_, largestPenetration_, largestStabilisedShare_);
  archive.field("states", states_);
  archive.field("sudden_work", suddenWork_);
  reactions_.archive(archive);
  archive.field("projection_seconds", projectionSeconds_);
}

template class RunHistory<2>;
template class RunHistory<3>;

}  // namespace burnish::inline analysis
