#include "engine/analysis/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>
#include <variant>

#include "engine/analysis/boundary_crossing.h"
#include "engine/core/stopwatch.h"
#include "engine/fields/body_fields.h"

namespace burnish {
namespace {

constexpr double kDoubtfulSpanShare = 0.1;
constexpr double kDoubtfulRadiusShare = 0.01;
constexpr double kDoubtfulJ = 0.05;
constexpr double kDoubtfulBoundary = 0.005;
constexpr double kCrossing = 1e-9;  // relative to the body's size
constexpr std::size_t kFirstToolDoubt = 5;

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
      doubts_{
          {"point-wise penetration above a tenth of a knot span or 1 % of the tool's radius"},
          {"smallest J below 0.05"},
          {scene.rezoning
               ? "fewer than three control points carry a contact for which no new mesh was found, or whose "
                 "face penetrates by more than a tenth of a knot span: the mesh does not resolve it any "
                 "more; give new meshes more spans (rezoning.spans)"
               : "fewer than three control points carry a contact whose face penetrates by more than a tenth "
                 "of a knot span: the mesh does not resolve it any more; `rezoning: {}` in the scene of a "
                 "plane body meshes it anew under way"},
          {scene.selfContact.empty()
               ? "a contact face crosses itself, as contact of the body with itself is not computed; "
                 "self_contact computes it for plane and axisymmetric bodies"
               : "a contact face crosses itself: name it under self_contact or, if it is there, give it a "
                 "larger "
                 "reach, finer steps or more knot spans"},
          {"the boundary of a new mesh is farther than 0.5 % of the body's size from the old one; give new "
           "meshes more spans (rezoning.spans)"}},
      touched_(model.tools().size(), false),
      rezones_(scene.rezoning.has_value()) {
  for (auto& sentence : toolWatch_.sentences()) doubts_.push_back({std::move(sentence)});
  firstTipDoubt_ = doubts_.size();
  doubts_.resize(firstTipDoubt_ + model.contacts().size());
  tips_.resize(model.contacts().size());
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
void Recorder<Dim>::update(const MeasuredState& state, const Eigen::VectorXd& force) {
  const Eigen::VectorXd& x = state.x;
  Eigen::VectorXd loads = loadForces();
  StateQuantities next;
  next.time = state.time;
  next.externalWork = current_.externalWork + workIncrement(x, force, loads);
  addTools(state, next);
  addSelfContacts(next);
  if (x_.size() > 0) next.externalWork += toolWork(next);

  const BulkTerm<Dim>& bulk = model_.bulk();
  next.strainEnergy = bulk.summary().strainEnergy;
  next.plasticWork = bulk.plasticWork();
  next.maxPlasticStrain = bulk.summary().maxPlasticStrain;
  next.minJ = bulk.summary().minJ;
  if (std::holds_alternative<J2Plasticity>(bulk.material())) {
    const Stopwatch stopwatch(projectionSeconds_);
    next.projectedPlasticStrain = extremes_(projection_.project(plasticStrain(bulk)).col(0));
  }

  measured_ = measures_.values(state);
  reactions_.update(state, force);
  current_ = std::move(next);
  x_ = x;
  force_ = force;
  loads_ = std::move(loads);
  watch();
}

template <int Dim>
void Recorder<Dim>::continueFrom(const Recorder& before) {
  current_ = before.current_;
  smallestJ_ = before.smallestJ_;
  largestPenetration_ = before.largestPenetration_;
  doubts_ = before.doubts_;
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
    const bool touchesItself = std::any_of(others.begin(), others.end(), [&](const SelfContact& other) {
      return other.patch == pair.patch && faceName(other.face) == pair.faceName;
    });
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
void Recorder<Dim>::watch() {
  smallestJ_ = std::min(smallestJ_, current_.minJ);
  largestPenetration_ = std::max({largestPenetration_, current_.maxPenetration, current_.maxSelfPenetration});

  bool penetrates = false;
  for (const auto& pair : model_.contacts()) {
    const double radius = halfThickness(model_.tools()[pair.tool]->shape);
    penetrates |= penetrationPerSpan(*pair.term) > kDoubtfulSpanShare ||
                  pair.term->state().largestPenetration() > kDoubtfulRadiusShare * radius;
  }
  for (const auto& contact : model_.selfContacts())
    penetrates |= penetrationPerSpan(*contact.term) > kDoubtfulSpanShare;
  const auto& contacts = model_.contacts();
  crossesItself_ = anyFaceCrossesItself();
  const auto note = [&](Doubt& doubt, bool holds) {
    if (!holds) return;
    if (doubt.steps == 0) doubt.firstTime = current_.time;
    ++doubt.steps;
  };
  note(doubts_[0], penetrates);
  note(doubts_[1], current_.minJ < kDoubtfulJ);
  note(doubts_[2], std::any_of(contacts.begin(), contacts.end(),
                               [&](const auto& pair) { return hasLostResolution(pair); }));
  note(doubts_[3], crossesItself_);
  note(doubts_[4], boundaryError_ > kDoubtfulBoundary * model_.body().size());
  const auto reached = toolWatch_.reached(current_.toolPoses, x_);
  for (std::size_t k = 0; k < reached.size(); ++k) note(doubts_[kFirstToolDoubt + k], reached[k]);
  const auto tips = tipWatch_.tips(current_.toolPoses, x_);
  for (std::size_t k = 0; k < tips.size(); ++k) {
    if (tips_[k].depth == 0.0) tips_[k] = tips[k];
    note(doubts_[firstTipDoubt_ + k], tips[k].depth > 0.0);
  }
  nameTips();

  for (const auto& pair : model_.contacts())
    if (pair.term->state().pressure.maxCoeff() > 0.0) touched_[pair.tool] = true;
}

template <int Dim>
void Recorder<Dim>::nameTips() {
  for (std::size_t k = 0; k < tips_.size(); ++k)
    if (tips_[k].depth > 0.0) doubts_[firstTipDoubt_ + k].what = tipWatch_.sentence(k, tips_[k]);
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
  for (std::size_t k = 0; k < doubts_.size(); ++k) {
    archive.field(fmt::format("doubt{}_first_time", k), doubts_[k].firstTime);
    archive.field(fmt::format("doubt{}_steps", k), doubts_[k].steps);
  }
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
