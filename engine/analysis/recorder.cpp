#include "engine/analysis/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/analysis/boundary_crossing.h"
#include "engine/analysis/contact_side.h"
#include "engine/core/stopwatch.h"
#include "engine/fields/body_fields.h"

namespace burnish {
namespace {

/// So many states are needed before sums of work mean much; a run of fewer is judged by its end alone.
constexpr int kCoarseStates = 10;

/// The field of a material law that has columns of its own in the history, zero for laws without it.
constexpr const char* kPlasticStrain = "plastic_strain";

constexpr double kCrossing = 1e-9;  // relative to the body's size

/// Largest penetration over the size of a span.
template <class Contact>
double penetrationPerSpan(const Contact& term) {
  double largest = 0.0;
  for (const auto& span : term.face().spans())
    largest = std::max(
        largest, -term.state().gap.segment(span.firstPoint, span.weights.size()).minCoeff() / span.size);
  return largest;
}

/// Whether the line through the columns crosses itself.
bool crossesItself(const Eigen::MatrixXd& line, double rounding) {
  std::vector<BoundaryPiece> pieces;
  for (Eigen::Index q = 1; q < line.cols(); ++q)
    if (line.col(q) != line.col(q - 1)) pieces.push_back({line.col(q - 1), line.col(q), {}});
  return findCrossing(pieces, rounding).has_value();
}

/// The same for a face that may touch itself: its parts may be inside of one another by what is not doubtful
/// yet.
bool crossesItself(const SelfContactTerm& term, double rounding) {
  return crossesItself(term.positionsApart(kDoubtfulSpanShare), rounding);
}

}  // namespace

template <int Dim>
Recorder<Dim>::Recorder(const Scene& scene, const Model<Dim>& model, const Projection<Dim>& projection)
    : model_(model),
      projection_(projection),
      extremes_(model.body()),
      measures_(scene, model, projection),
      reactions_(scene, model),
      listsReactions_(scene.output.reactions),
      toolWatch_(model),
      tipWatch_(model),
      doubts_(commonDoubts(scene.rezoning.has_value(), !scene.selfContact.empty())),
      tipDoubts_(model.contacts().size()),
      tips_(model.contacts().size()),
      touched_(model.tools().size(), false),
      rezones_(scene.rezoning.has_value()) {
  for (auto& sentence : toolWatch_.sentences()) toolDoubts_.push_back({std::move(sentence)});
}

template <int Dim>
std::vector<std::string> Recorder<Dim>::columns() const {
  constexpr std::array<const char*, 3> axes{"x", "y", "z"};
  std::vector<std::string> columns{"step", "time"};
  for (const auto& tool : model_.tools()) {
    for (const char* quantity : {".u", ".f"})
      for (std::size_t d = 0; d < Dim; ++d) columns.push_back(tool->name + quantity + axes[d]);
    if (model_.body().axisymmetric) continue;
    for (std::size_t d = Dim == 2 ? 2 : 0; d < 3; ++d) columns.push_back(tool->name + ".m" + axes[d]);
    columns.push_back(tool->name + ".angle");
  }
  for (const char* name :
       {"strain_energy", "contact_energy", "external_work", "plastic_work", "max_plastic_strain",
        "max_plastic_strain_projected", "min_plastic_strain_projected", "active_control_points",
        "max_penetration", "min_detJ", "newton_iterations"})
    columns.emplace_back(name);
  if (!model_.selfContacts().empty())
    for (const char* name : {"self_active_control_points", "max_self_penetration", "self_contact_force"})
      columns.emplace_back(name);
  if (rezones_)
    for (const char* name : {"rezonings", "rezoning_energy_lost", "rezoning_gap_work",
                             "rezoning_volume_drift", "rezoning_boundary_error", "crosses_itself"})
      columns.emplace_back(name);
  if (listsReactions_)
    for (auto& column : reactions_.columns()) columns.push_back(std::move(column));
  for (auto& column : measures_.columns()) columns.push_back(std::move(column));
  return columns;
}

template <int Dim>
Eigen::VectorXd Recorder<Dim>::loadForces() const {
  Eigen::VectorXd sum;
  for (const auto& load : model_.loads())
    sum = sum.size() == 0 ? load->nodalForces() : Eigen::VectorXd(sum + load->nodalForces());
  return sum;
}

template <int Dim>
double Recorder<Dim>::workIncrement(const Eigen::VectorXd& x, const Eigen::VectorXd& force,
                                    const Eigen::VectorXd& loads) const {
  if (x_.size() == 0) return 0.0;
  double work = 0.0;
  const Eigen::VectorXd increment = x - x_;
  for (Eigen::Index i = 0; i < model_.numDisplacements(); ++i)
    if (model_.prescribed()[static_cast<std::size_t>(i)]) work += 0.5 * (force_(i) + force(i)) * increment(i);
  if (loads_.size() > 0) work += 0.5 * (loads_ + loads).dot(increment.head(model_.numDisplacements()));
  return work;
}

template <int Dim>
void Recorder<Dim>::addTools(const MeasuredState& state, StateQuantities& next) const {
  for (const auto& tool : model_.tools()) next.toolPoses.push_back(tool->pose(state.time, state.x));
  next.toolForces.assign(model_.tools().size(), Eigen::Vector3d::Zero());
  next.toolMoments = next.toolForces;
  for (const auto& pair : model_.contacts()) {
    const ContactState& contact = pair.term->state();
    next.toolForces[pair.tool] += contact.reaction;
    next.toolMoments[pair.tool] += contact.moment;
    next.contactEnergy += contact.energy;
    next.activeControlPoints += contact.numActive();
    next.maxPenetration = std::max(next.maxPenetration, contact.largestPenetration());
  }
}

template <int Dim>
void Recorder<Dim>::addSelfContacts(StateQuantities& next) const {
  for (const auto& contact : model_.selfContacts()) {
    const SelfContactState& state = contact.term->state();
    next.selfActiveControlPoints += state.numActive();
    next.maxSelfPenetration = std::max(next.maxSelfPenetration, state.largestPenetration());
    next.selfForce += state.force.norm();
  }
}

/// Work of the tools on the body since the last state.
template <int Dim>
double Recorder<Dim>::toolWork(const StateQuantities& next) const {
  double work = 0.0;
  for (std::size_t k = 0; k < next.toolForces.size(); ++k) {
    const ToolPose &from = current_.toolPoses[k], &to = next.toolPoses[k];
    const double moment = model_.tools()[k]->axis.dot(current_.toolMoments[k] + next.toolMoments[k]);
    work -= 0.5 * (current_.toolForces[k] + next.toolForces[k]).dot(to.displacement - from.displacement) +
            0.5 * moment * (to.angle - from.angle);
  }
  return work;
}

template <int Dim>
void Recorder<Dim>::update(const MeasuredState& state, const Eigen::VectorXd& force,
                           const Equilibrium& equilibrium) {
  const Eigen::VectorXd& x = state.x;
  Eigen::VectorXd loads = loadForces();
  StateQuantities next;
  next.time = state.time;
  next.externalWork = current_.externalWork + workIncrement(x, force, loads);
  // A load that is there at once does twice the work of one that grows, and the rest would set the body in
  // motion.
  if (++states_ == 2 && loads_.size() > 0) suddenWork_ = 0.5 * loads_.dot((x - x_).head(loads_.size()));
  addTools(state, next);
  addSelfContacts(next);
  if (x_.size() > 0) next.externalWork += toolWork(next);

  const BulkTerm<Dim>& bulk = model_.bulk();
  next.strainEnergy = bulk.summary().strainEnergy;
  next.plasticWork = bulk.plasticWork();
  next.minJ = bulk.summary().minJ;
  next.stabilisedShare = equilibrium.stabilisedShare;
  next.stabilisationWork = current_.stabilisationWork;
  if (const auto* stabilisation = model_.stabilisation()) next.stabilisationWork += stabilisation->work();
  if (bulk.points().hasField(kPlasticStrain)) {
    const Eigen::VectorXd strain = bulk.points().field(kPlasticStrain).row(0);
    next.maxPlasticStrain = strain.maxCoeff();
    const Stopwatch stopwatch(projectionSeconds_);
    next.projectedPlasticStrain = extremes_(projection_.project(strain).col(0));
  }
  next.largestEnergy = std::max(current_.largestEnergy, std::abs(next.energyFound()));

  measured_ = measures_.values(state);
  reactions_.update(state, force);
  current_ = std::move(next);
  x_ = x;
  force_ = force;
  loads_ = std::move(loads);
  watch(equilibrium);
}

template <int Dim>
Extremes Recorder<Dim>::projectedVonMises() const {
  const Eigen::MatrixXd mises = quadratureFields(model_.bulk(), "").at("von_mises").values;
  return extremes_(projection_.project(mises.transpose()).col(0));
}

template <int Dim>
void Recorder<Dim>::continueFrom(const Recorder& before) {
  current_ = before.current_;
  smallestJ_ = before.smallestJ_;
  largestPenetration_ = before.largestPenetration_;
  largestStabilisedShare_ = before.largestStabilisedShare_;
  states_ = before.states_;
  suddenWork_ = before.suddenWork_;
  doubts_ = before.doubts_;
  toolDoubts_ = before.toolDoubts_;
  tipDoubts_ = before.tipDoubts_;
  tips_ = before.tips_;
  touched_ = before.touched_;
  reactions_.continueFrom(before.reactions_);
  rezonings_ = before.rezonings_;
  energyLost_ = before.energyLost_;
  gapWork_ = before.gapWork_;
  volumeDrift_ = before.volumeDrift_;
  boundaryError_ = before.boundaryError_;
  projectionSeconds_ = before.projectionSeconds_;
}

template <int Dim>
void Recorder<Dim>::noteRezoning(const RezoningRecord& rezoning) {
  ++rezonings_;
  energyLost_ += rezoning.energyLost;
  gapWork_ += rezoning.gapWork;
  volumeDrift_ = rezoning.volumeDrift;
  boundaryError_ = std::max(boundaryError_, rezoning.boundaryError);
}

template <int Dim>
bool Recorder<Dim>::hasLostResolution(const ContactPair<Dim>& pair) const {
  const int active = pair.term->state().numActive();
  return active > 0 && active < 3 && (needsNewMesh_ || penetrationPerSpan(*pair.term) > kDoubtfulSpanShare);
}

template <int Dim>
bool Recorder<Dim>::faceCrossesItself(const ContactPair<Dim>& pair) const {
  if constexpr (Dim == 2) {
    const auto& others = model_.selfContacts();
    const bool touchesItself = std::any_of(
        others.begin(), others.end(), [&](const SelfContact& other) { return other.place == pair.place; });
    return !touchesItself &&
           burnish::crossesItself(pair.term->face().positions(x_), kCrossing * model_.body().size());
  }
  return false;
}

template <int Dim>
bool Recorder<Dim>::anyFaceCrossesItself() const {
  const auto& contacts = model_.contacts();
  const auto& selfContacts = model_.selfContacts();
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const auto& pair) { return faceCrossesItself(pair); }) ||
         std::any_of(selfContacts.begin(), selfContacts.end(), [&](const SelfContact& contact) {
           return burnish::crossesItself(*contact.term, kCrossing * model_.body().size());
         });
}

template <int Dim>
void Recorder<Dim>::note(Condition condition, bool holds, double value) {
  if (holds) doubts_[static_cast<std::size_t>(condition)].note(current_.time, value);
}

template <int Dim>
void Recorder<Dim>::watch(const Equilibrium& equilibrium) {
  smallestJ_ = std::min(smallestJ_, current_.minJ);
  largestPenetration_ = std::max({largestPenetration_, current_.maxPenetration, current_.maxSelfPenetration});
  largestStabilisedShare_ = std::max(largestStabilisedShare_, current_.stabilisedShare);
  crossesItself_ = anyFaceCrossesItself();
  note(Condition::SmallJ, current_.minJ < kDoubtfulJ, 1.0 / current_.minJ);
  note(Condition::CrossesItself, crossesItself_);
  note(Condition::NewBoundary, boundaryError_ > kDoubtfulBoundary * model_.body().size());
  note(Condition::Unstable, equilibrium.unstableDirections > 0, equilibrium.unstableDirections);
  note(Condition::Stabilisation, current_.stabilisedShare > kDoubtfulStabilisation, current_.stabilisedShare);
  watchContacts();
  if (states_ > kCoarseStates) watchWork();
  watchTools();
}

template <int Dim>
void Recorder<Dim>::watchContacts() {
  double refinement = 0.0, inside = 0.0;
  bool lost = false;
  for (const auto& pair : model_.contacts()) {
    const double radius = model_.tools()[pair.tool]->shape.halfThickness();
    // On finer spans the penetration falls with the square of their size.
    refinement =
        std::max({refinement, penetrationPerSpan(*pair.term) / kDoubtfulSpanShare,
                  std::sqrt(pair.term->state().largestPenetration() / (kDoubtfulRadiusShare * radius))});
    inside = std::max(inside, forceFromInside(model_.body(), pair, x_));
    lost = lost || hasLostResolution(pair);
    if (pair.term->state().pressure.maxCoeff() > 0.0) touched_[pair.tool] = true;
  }
  for (const auto& contact : model_.selfContacts())
    refinement = std::max(refinement, penetrationPerSpan(*contact.term) / kDoubtfulSpanShare);
  note(Condition::Penetration, refinement > 1.0, refinement);
  note(Condition::LostContact, lost);
  note(Condition::InsideTheBody, inside > kDoubtfulInside, inside);
}

template <int Dim>
void Recorder<Dim>::watchWork() {
  const double imbalance = imbalanceOf(
      current_.energyFound(), current_.externalWork + (gapWork_ - suddenWork_), current_.largestEnergy);
  note(Condition::Balance, imbalance > kDoubtfulBalance, imbalance);
}

template <int Dim>
void Recorder<Dim>::noteEnd() {
  if (states_ <= kCoarseStates) watchWork();
}

template <int Dim>
void Recorder<Dim>::watchTools() {
  const auto reached = toolWatch_.reached(current_.toolPoses, x_);
  for (std::size_t k = 0; k < reached.size(); ++k)
    if (reached[k]) toolDoubts_[k].note(current_.time, 0.0);
  const auto tips = tipWatch_.tips(current_.toolPoses, x_);
  for (std::size_t k = 0; k < tips.size(); ++k) {
    if (tips_[k].depth == 0.0) tips_[k] = tips[k];
    if (tips[k].depth > 0.0) tipDoubts_[k].note(current_.time, 0.0);
  }
  nameTips();
}

template <int Dim>
void Recorder<Dim>::nameTips() {
  for (std::size_t k = 0; k < tips_.size(); ++k)
    if (tips_[k].depth > 0.0) tipDoubts_[k].what = tipWatch_.sentence(k, tips_[k]);
}

template <int Dim>
std::vector<DoubtRecord> Recorder<Dim>::doubts() const {
  std::vector<DoubtRecord> records;
  const auto add = [&](const Doubt& doubt, std::string detail) {
    if (doubt.steps > 0) records.push_back({doubt.what, doubt.firstTime, doubt.steps, std::move(detail)});
  };
  for (std::size_t k = 0; k < doubts_.size(); ++k)
    add(doubts_[k], detailOf(static_cast<Condition>(k), doubts_[k]));
  for (const Doubt& doubt : toolDoubts_) add(doubt, "");
  for (const Doubt& doubt : tipDoubts_) add(doubt, "");
  return records;
}

template <int Dim>
std::vector<std::string> Recorder<Dim>::idleTools() const {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < touched_.size(); ++k) {
    const auto& contacts = model_.contacts();
    const bool paired =
        std::any_of(contacts.begin(), contacts.end(), [&](const auto& pair) { return pair.tool == k; });
    if (paired && !touched_[k]) names.push_back(model_.tools()[k]->name);
  }
  return names;
}

template <int Dim>
std::vector<double> Recorder<Dim>::row(int step, int newtonIterations) const {
  std::vector<double> row{static_cast<double>(step), current_.time};
  for (std::size_t k = 0; k < current_.toolForces.size(); ++k) {
    for (int d = 0; d < Dim; ++d) row.push_back(current_.toolPoses[k].displacement(d));
    for (int d = 0; d < Dim; ++d) row.push_back(current_.toolForces[k](d));
    if (model_.body().axisymmetric) continue;
    for (int d = Dim == 2 ? 2 : 0; d < 3; ++d) row.push_back(current_.toolMoments[k](d));
    row.push_back(current_.toolPoses[k].angle * 180.0 / std::numbers::pi);
  }
  for (const double value :
       {current_.strainEnergy, current_.contactEnergy, current_.externalWork, current_.plasticWork,
        current_.maxPlasticStrain, current_.projectedPlasticStrain.max, current_.projectedPlasticStrain.min,
        static_cast<double>(current_.activeControlPoints), current_.maxPenetration, current_.minJ,
        static_cast<double>(newtonIterations)})
    row.push_back(value);
  if (!model_.selfContacts().empty())
    for (const double value : {static_cast<double>(current_.selfActiveControlPoints),
                               current_.maxSelfPenetration, current_.selfForce})
      row.push_back(value);
  if (rezones_)
    for (const double value : {static_cast<double>(rezonings_), energyLost_, gapWork_, volumeDrift_,
                               boundaryError_, crossesItself_ ? 1.0 : 0.0})
      row.push_back(value);
  if (listsReactions_)
    for (const double value : reactions_.values()) row.push_back(value);
  row.insert(row.end(), measured_.begin(), measured_.end());
  return row;
}

void StateQuantities::archive(StateArchive& archive) {
  archive.field("time", time);
  const std::size_t tools = toolPoses.size();
  for (std::size_t k = 0; k < tools; ++k) {
    const std::string name = fmt::format("tool{}_", k);
    archive.field(name + "displacement", toolPoses[k].displacement);
    archive.field(name + "angle", toolPoses[k].angle);
    archive.field(name + "force", toolForces[k]);
    archive.field(name + "moment", toolMoments[k]);
  }
  archive.field("strain_energy", strainEnergy);
  archive.field("contact_energy", contactEnergy);
  archive.field("external_work", externalWork);
  archive.field("plastic_work", plasticWork);
  archive.field("max_plastic_strain", maxPlasticStrain);
  archive.field("min_projected_plastic_strain", projectedPlasticStrain.min);
  archive.field("max_projected_plastic_strain", projectedPlasticStrain.max);
  archive.field("active_control_points", activeControlPoints);
  archive.field("max_penetration", maxPenetration);
  archive.field("self_active_control_points", selfActiveControlPoints);
  archive.field("max_self_penetration", maxSelfPenetration);
  archive.field("self_contact_force", selfForce);
  archive.field("min_J", minJ);
  archive.field("stabilisation_work", stabilisationWork);
  archive.field("stabilised_share", stabilisedShare);
  archive.field("largest_energy", largestEnergy);
}

template <int Dim>
void Recorder<Dim>::archive(StateArchive& archive) {
  const std::size_t tools = model_.tools().size();
  current_.toolPoses.resize(tools);
  current_.toolForces.resize(tools, Eigen::Vector3d::Zero());
  current_.toolMoments.resize(tools, Eigen::Vector3d::Zero());
  archive.part("current", current_);
  archive.field("measured", measured_);
  archive.field("x", x_);
  archive.field("force", force_);
  archive.field("loads", loads_);
  archive.field("smallest_J", smallestJ_);
  archive.field("largest_penetration", largestPenetration_);
  archive.field("largest_stabilised_share", largestStabilisedShare_);
  archive.field("states", states_);
  archive.field("sudden_work", suddenWork_);
  archiveDoubts(archive, "doubts", doubts_);
  archiveDoubts(archive, "tool_doubts", toolDoubts_);
  archiveDoubts(archive, "tip_doubts", tipDoubts_);
  int crosses = crossesItself_ ? 1 : 0;
  archive.field("crosses_itself", crosses);
  crossesItself_ = crosses == 1;
  for (std::size_t k = 0; k < tips_.size(); ++k) {
    archive.field(fmt::format("tip{}_depth", k), tips_[k].depth);
    archive.field(fmt::format("tip{}_turn", k), tips_[k].turn);
    archive.field(fmt::format("tip{}_span", k), tips_[k].span);
  }
  nameTips();
  archive.fixedField("touched", touched_);
  reactions_.archive(archive);
  archive.field("projection_seconds", projectionSeconds_);
  int needsNewMesh = needsNewMesh_ ? 1 : 0;
  archive.field("needs_new_mesh", needsNewMesh);
  needsNewMesh_ = needsNewMesh == 1;
  archive.field("rezonings", rezonings_);
  archive.field("rezoning_energy_lost", energyLost_);
  archive.field("rezoning_gap_work", gapWork_);
  archive.field("rezoning_volume_drift", volumeDrift_);
  archive.field("rezoning_boundary_error", boundaryError_);
}

template class Recorder<2>;
template class Recorder<3>;

}  // namespace burnish
