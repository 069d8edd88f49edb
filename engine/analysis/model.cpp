#include "engine/analysis/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/analysis/geometry.h"
#include "engine/analysis/geometry_check.h"
#include "engine/analysis/materials.h"
#include "engine/analysis/time_grid.h"
#include "engine/analysis/tool_start.h"
#include "engine/analysis/tools.h"
#include "engine/core/input_error.h"
#include "engine/scene/scene_places.h"
#include "engine/solid/dead_load.h"
#include "engine/solid/follower_load.h"

namespace burnish {
namespace {

Enforcement enforcementOf(ContactMethod method) {
  switch (method) {
    case ContactMethod::AugmentedLagrangian:
      return Enforcement::AugmentedLagrangian;
    case ContactMethod::Penalty:
      return Enforcement::MortarPenalty;
    case ContactMethod::PointwisePenalty:
      return Enforcement::PointwisePenalty;
  }
  return Enforcement::AugmentedLagrangian;
}

Formulation formulationOf(const Scene& scene) {
  return scene.formulation == FormulationChoice::Fbar ? Formulation::ProjectedDilatation
                                                      : Formulation::Displacement;
}

/// ε when the scene does not say: the augmented Lagrangian's answer does not depend on it, the penalty
/// methods trade penetration against conditioning.
double defaultParameter(Enforcement enforcement, double E, double L) {
  return (enforcement == Enforcement::AugmentedLagrangian ? 1.0 : 100.0) * E / L;
}

/// Smallest force that counts over E L (E L² in 3D and axisymmetry).
constexpr double kForceFloor = 1e-9;

/// Path of what a load is given by.
std::string loadKey(const Scene& scene, std::size_t number) {
  const LoadSpec& load = scene.loads[number];
  return fmt::format("loads[{}].{}", number,
                     !load.bodyForce.empty()  ? "body_force"
                     : !load.traction.empty() ? "traction"
                     : load.pressure          ? "pressure"
                                              : "shear");
}

/// Gathers the formulas of a motion or load of tools, in t alone, that have no finite value at one of the
/// times.
template <class Spec>
void gatherInfinite(const std::string& path, const Spec& spec, const std::optional<FormulaText>& turn,
                    const char* turnKey, const Scene& scene, const std::vector<double>& times,
                    InputProblems& problems) {
  const std::array<std::pair<const char*, const std::optional<FormulaText>*>, kToolWays> ways{
      {{"x", &spec.x}, {"y", &spec.y}, {"z", &spec.z}, {turnKey, &turn}}};
  for (const auto& [key, text] : ways)
    if (*text)
      problems.gather([&] {
        placed(fmt::format("{}.{}", path, key), [&] {
          requireFinite({Formula(**text, scene.definitions)}, Eigen::Matrix3Xd::Zero(3, 1), times);
        });
      });
}

/// Reach of self-contact when the scene does not say, in parts of the body's size.
constexpr double kReach = 0.05;

}  // namespace

template <int Dim>
Model<Dim>::Model(const Scene& scene) : Model(scene, makeBody<Dim>(scene)) {}

template <int Dim>
Model<Dim>::Model(const Scene& scene, NamedBody<Dim> named)
    : body_(std::move(named.body)), faces_(body_, std::move(named.names)), supports_(scene, faces_) {
  requireSoundGeometry(faces_, scene);
  quadrature_ = std::make_unique<SpanQuadrature<Dim>>(body_, scene.quadraturePoints.value_or(0));
  bulk_ = makeBulkTerm(body_, *quadrature_, makeMaterial(scene.material), formulationOf(scene));
  addBoundary(scene);
  requireFiniteFormulas(scene);
  liftTools(scene);
  addStabilisation(scene);
  InputProblems problems;
  for (const auto& load : toolLoads_) problems.gather([&] { placeFreeTool(*load, scene); });
  problems.throwIfAny();
}

template <int Dim>
Model<Dim>::Model(const Scene& scene, RezonedBody<Dim> rezoned)
    : body_(std::move(rezoned.named.body)),
      faces_(body_, std::move(rezoned.named.names)),
      supports_(scene, faces_),
      rezoned_(true),
      startTime_(rezoned.time) {
  quadrature_ = std::make_unique<SpanQuadrature<Dim>>(body_, scene.quadraturePoints.value_or(0));
  ReferenceState reference = referenceState(*quadrature_, rezoned.states);
  reference.plasticWork = rezoned.plasticWork;
  bulk_ = makeBulkTerm(body_, *quadrature_, makeMaterial(scene.material), formulationOf(scene), reference);
  addBoundary(scene);
  addStabilisation(scene);
  supports_.setValues(startTime_, origin_);
}

/// Supports, loads, tools and contact pairs, with all unknowns.
template <int Dim>
void Model<Dim>::addBoundary(const Scene& scene) {
  prescribed_ = supports_.prescribed();
  corners_ = supports_.corners();
  InputProblems problems;
  for (std::size_t k = 0; k < scene.loads.size(); ++k)
    problems.gather([&] {
      if (rezoned_) return addLoad(scene, k);  // of a run under way
      placed(loadKey(scene, k), [&] { addLoad(scene, k); });
    });
  numForces_ = numDisplacements();
  for (std::size_t k = 0; k < scene.tools.size(); ++k) problems.gather([&] { addTool(scene, k); });
  problems.throwIfAny();
  numUnknowns_ = numForces_;
  for (std::size_t k = 0; k < scene.contact.size(); ++k) problems.gather([&] { addContact(scene, k); });
  for (std::size_t k = 0; k < scene.selfContact.size(); ++k)
    problems.gather([&] { addSelfContact(scene, k); });
  prescribed_.resize(static_cast<std::size_t>(numUnknowns_), false);
  if (!rezoned_ && !scene.stabilise) problems.gather([this] { requireSupported(); });
  problems.throwIfAny();
  std::sort(corners_.begin(), corners_.end());
  corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
  start_ = Eigen::VectorXd::Zero(numUnknowns_);
  origin_ = start_;
}

template <int Dim>
void Model<Dim>::addLoad(const Scene& scene, std::size_t number) {
  const auto& load = scene.loads[number];
  const Schedule factor = load.schedule.value_or(Schedule{});
  corners_.insert(corners_.end(), factor.times.begin(), factor.times.end());
  if (!load.bodyForce.empty()) {
    const int patch = load.place.patch.empty() ? -1 : faces_.patch(load.place.patch);
    loads_.push_back(std::make_unique<DeadLoad<Dim>>(
        body_, *quadrature_, patch, makeFormulas(load.bodyForce, scene.definitions), factor));
    return;
  }
  faces_.requireOuter(load.place, fmt::format("loads[{}]", number));
  const int patch = faces_.patch(load.place.patch);
  const FaceId side = faceFromName<Dim>(load.place.face);
  FaceQuadrature<Dim> face(body_, patch, side, 0, faces_.part(load.place, fmt::format("loads[{}]", number)));
  if (!load.traction.empty()) {
    loads_.push_back(
        std::make_unique<DeadLoad<Dim>>(body_, face, makeFormulas(load.traction, scene.definitions), factor));
    return;
  }
  const auto direction =
      load.pressure ? FollowerLoad<Dim>::Direction::Pressure : FollowerLoad<Dim>::Direction::Shear;
  loads_.push_back(std::make_unique<FollowerLoad<Dim>>(
      body_, patch, side, std::move(face), direction,
      Formula(load.pressure ? *load.pressure : *load.shear, scene.definitions), factor));
}

template <int Dim>
void Model<Dim>::requireFiniteFormulas(const Scene& scene) const {
  std::vector<double> times{0.0};
  for (const TimePoint& point : timeGrid(scene, corners_)) times.push_back(point.time);
  InputProblems problems;
  problems.gather([&] { supports_.requireFinite(times); });
  for (std::size_t k = 0; k < loads_.size(); ++k)
    problems.gather([&] { placed(loadKey(scene, k), [&] { loads_[k]->requireFinite(times); }); });
  for (std::size_t k = 0; k < scene.tools.size(); ++k) {
    const ToolSpec& tool = scene.tools[k];
    const std::string path = fmt::format("tools[{}]", k);
    if (const auto& p = tool.prescribe)
      gatherInfinite(path + ".prescribe", *p, p->angle, "angle", scene, times, problems);
    if (const auto& c = tool.carry)
      gatherInfinite(path + ".carry", *c, c->moment, "moment", scene, times, problems);
  }
  problems.throwIfAny();
}

template <int Dim>
void Model<Dim>::addTool(const Scene& scene, std::size_t number) {
  const auto& spec = scene.tools[number];
  try {
    tools_.push_back(makeTool(spec, scene, numForces_, body_.size()));
  } catch (const Error& error) {
    throw InputError(fmt::format("tools[{}]", number), error.what());
  }
  numForces_ += static_cast<int>(tools_.back()->freeUnknowns().size());
  if (auto load = makeToolLoad(spec, scene, *tools_.back())) toolLoads_.push_back(std::move(load));
  const auto corners = cornersOf(spec);
  corners_.insert(corners_.end(), corners.begin(), corners.end());
}

template <int Dim>
void Model<Dim>::addContact(const Scene& scene, std::size_t number) {
  const auto& spec = scene.contact[number];
  const auto tool = static_cast<std::size_t>(
      std::find_if(tools_.begin(), tools_.end(), [&](const auto& t) { return t->name == spec.tool; }) -
      tools_.begin());
  if (!rezoned_) requireReachable(*tools_[tool], spec, fmt::format("contact[{}]", number));
  const int patch = faces_.patch(spec.place.patch);
  const Enforcement enforcement = enforcementOf(spec.method);
  typename ContactTerm<Dim>::Options options{
      enforcement,
      spec.parameter.value_or(defaultParameter(enforcement, youngsModulus(bulk_->material()), body_.size())),
      spec.quadraturePoints.value_or(0), spec.gapLimit.value_or(std::numeric_limits<double>::infinity())};
  auto term = std::make_unique<ContactTerm<Dim>>(body_, patch, faceFromName<Dim>(spec.place.face),
                                                 *tools_[tool], options, numUnknowns_);
  numUnknowns_ += term->numMultipliers();
  contacts_.push_back({tool, patch, spec.place.face, std::move(term)});
}

template <int Dim>
void Model<Dim>::addSelfContact(const Scene& scene, std::size_t number) {
  if constexpr (Dim == 2) {
    const auto& spec = scene.selfContact[number];
    faces_.requireOuter(spec.place, fmt::format("self_contact[{}]", number));
    const double E = youngsModulus(bulk_->material()), L = body_.size();
    const SelfContactTerm::Options options{
        spec.parameter.value_or(defaultParameter(Enforcement::AugmentedLagrangian, E, L)),
        spec.reach.value_or(kReach * L), spec.quadraturePoints.value_or(0),
        spec.gapLimit.value_or(std::numeric_limits<double>::infinity()), rezoned_};
    const int patch = faces_.patch(spec.place.patch);
    const FaceId face = faceFromName<2>(spec.place.face);
    std::unique_ptr<SelfContactTerm> term;
    try {
      term = std::make_unique<SelfContactTerm>(body_, patch, face, options, numUnknowns_);
    } catch (const Error& error) {
      throw InputError(fmt::format("self_contact[{}]", number), error.what());
    }
    numUnknowns_ += term->numMultipliers();
    selfContacts_.push_back({patch, face, std::move(term)});
  }
}

template <int Dim>
void Model<Dim>::requireReachable(const Tool& tool, const ContactSpec& spec, const std::string& place) const {
  faces_.requireOuter(spec.place, place);
  const NearestPoint nearest =
      nearestPoint(body_, faces_.patch(spec.place.patch), faceFromName<Dim>(spec.place.face), tool, 0.0);
  if (-nearest.gap > kTouching * std::min(halfThickness(tool.shape), body_.size()))
    throw InputError(place, fmt::format("tool '{}' overlaps face '{}' by {:.3g} at the start; move it away "
                                        "by at least that much (touching is fine)",
                                        spec.tool, spec.place.face, -nearest.gap));
  if (nearest.facing > 0.5)
    throw InputError(place, fmt::format("tool '{}' is behind face '{}' at the start, inside the body or on "
                                        "its other side; put it in front of the face",
                                        spec.tool, spec.place.face));
  const auto nodes = faces_.nodes(spec.place);
  const bool held = std::all_of(nodes.begin(), nodes.end(), [&](int node) {
    const auto first = prescribed_.begin() + Dim * node;
    return std::all_of(first, first + Dim, [](bool flag) { return flag; });
  });
  if (held)
    throw InputError(
        place,
        fmt::format(
            "face '{}' is held in all its components, so tool '{}' cannot move it; name a face that is free",
            spec.place.face, spec.tool));
}

template <int Dim>
std::vector<ContactTerm<Dim>*> Model<Dim>::pairsOf(std::size_t tool) const {
  std::vector<ContactTerm<Dim>*> pairs;
  for (const auto& pair : contacts_)
    if (pair.tool == tool) pairs.push_back(pair.term.get());
  return pairs;
}

template <int Dim>
void Model<Dim>::addStabilisation(const Scene& scene) {
  if (!scene.stabilise) return;
  const double end = scene.stabilise->until.value_or(scene.steps.front().until);
  // η V (L / T) = strength E L (E L² in 3D)
  const double force = scene.stabilise->strength * forceFloor() / kForceFloor;
  const double viscosity = force * end / (quadrature_->volume() * body_.size());
  stabilisation_ = std::make_unique<Stabilisation<Dim>>(
      *quadrature_, typename Stabilisation<Dim>::Options{viscosity, startTime_, end});
}

template <int Dim>
double Model<Dim>::stabilisedShare(const std::vector<Eigen::VectorXd>& forces) const {
  if (!stabilisation_ || stabilisation_->force() < forceFloor()) return 0.0;
  const Eigen::Index n = numDisplacements();
  double largest = stabilisation_->force();
  for (std::size_t k = 1; k + 1 < forces.size(); ++k)  // the body's own forces hold one another
    largest = std::max(largest, forces[k].head(n).template lpNorm<1>());
  return stabilisation_->force() / largest;
}

template <int Dim>
void Model<Dim>::liftTools(const Scene& scene) {
  constexpr int kApproachSteps = 4;
  const double approachTime = kApproachSteps * scene.steps.front().until / scene.steps.front().count;
  for (std::size_t k = 0; k < tools_.size(); ++k) {
    if (!tools_[k]->freeUnknowns().empty()) continue;  // finds its own height
    std::vector<const ContactTerm<Dim>*> pairs;
    for (const auto* pair : pairsOf(k))
      if (pair->options().enforcement != Enforcement::PointwisePenalty) pairs.push_back(pair);
    if (pairs.empty()) continue;
    tools_[k]->lift = liftToSeparate<Dim>(pairs, *tools_[k], body_.size(), fmt::format("tools[{}]", k));
    if (tools_[k]->lift.isZero(0.0)) continue;
    tools_[k]->approachTime = approachTime;
    startTime_ = -approachTime;
  }
}

template <int Dim>
void Model<Dim>::placeFreeTool(const ToolLoad& load, const Scene& scene) {
  const Tool& tool = load.tool();
  const auto pairs = pairsOf(numberOf(tool));
  const std::string place = fmt::format("tools[{}].carry", numberOf(tool));
  if (pairs.empty())
    throw InputError(
        place,
        fmt::format("tool '{}' is free to move, but touches no face; name it under contact", tool.name));
  requireDetermined(tool, place, Dim, body_.size());
  pairs.back()->keepInTouch({pairs.begin(), pairs.end() - 1});
  const bool slides = tool.isFree(0) || tool.isFree(1) || tool.isFree(2);
  if (!slides) {
    requireTouch<Dim>({pairs.begin(), pairs.end()}, tool, body_.size(), place);
    return;
  }
  const Eigen::Vector3d direction = firstDirection(load, scene.steps.back().until);
  if (direction.isZero(0.0))
    throw InputError(
        place, fmt::format("tool '{}' carries no force at any time; give it one, or prescribe its motion",
                           tool.name));
  const Eigen::Vector3d shift =
      shiftToTouch<Dim>({pairs.begin(), pairs.end()}, tool, direction, body_.size(), place);
  for (std::size_t way = 0; way < kTurn; ++way)
    if (tool.isFree(way)) start_(tool.unknowns[way]) = shift(static_cast<Eigen::Index>(way));
}

template <int Dim>
std::size_t Model<Dim>::numberOf(const Tool& tool) const {
  const auto it =
      std::find_if(tools_.begin(), tools_.end(), [&](const auto& other) { return other.get() == &tool; });
  return static_cast<std::size_t>(it - tools_.begin());
}

template <int Dim>
std::string Model<Dim>::runawayWay() const {
  for (const auto& load : toolLoads_)
    if (const auto way = load->runaway())
      return fmt::format("tools[{}].carry.{}", numberOf(load->tool()), kCarryKeys[*way]);
  return {};
}

template <int Dim>
std::string Model<Dim>::pulledTool() const {
  const double smallest = forceFloor();
  for (const auto& pair : contacts_)
    if (pair.term->state().pull > smallest) return tools_[pair.tool]->name;
  return {};
}

template <int Dim>
void Model<Dim>::requireSupported() const {
  // The rigid motions of the reference body must not all fit the supports: their values at the prescribed
  // unknowns have to be linearly independent.
  const int numRigid = body_.axisymmetric ? 1 : Dim == 2 ? 3 : 6;
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(numDisplacements(), numRigid);
  const Eigen::MatrixXd positions = body_.nodePositions() / body_.size();
  for (int a = 0; a < body_.numNodes; ++a) {
    if (body_.axisymmetric) {
      motions(Dim * a + 1, 0) = 1.0;
      continue;
    }
    for (int d = 0; d < Dim; ++d) motions(Dim * a + d, d) = 1.0;
    int column = Dim;
    for (int i = 0; i < Dim; ++i)
      for (int j = i + 1; j < Dim; ++j, ++column) {
        motions(Dim * a + i, column) = -positions(j, a);
        motions(Dim * a + j, column) = positions(i, a);
      }
  }
  std::vector<int> held;
  for (int i = 0; i < numDisplacements(); ++i)
    if (prescribed_[static_cast<std::size_t>(i)]) held.push_back(i);
  const Eigen::MatrixXd atSupports = motions(held, Eigen::all);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(atSupports);
  qr.setThreshold(1e-10);
  const int freeWays = numRigid - (held.empty() ? 0 : static_cast<int>(qr.rank()));
  if (freeWays > 0)
    throw InputError(
        "supports",
        fmt::format(
            "they leave the body free to move as a rigid whole in {} way{}; hold more components or faces",
            freeWays, freeWays == 1 ? "" : "s"));
}

template <int Dim>
std::vector<Term*> Model<Dim>::terms() const {
  std::vector<Term*> terms{bulk_.get()};
  for (const auto& pair : contacts_) terms.push_back(pair.term.get());
  for (const auto& contact : selfContacts_) terms.push_back(contact.term.get());
  for (const auto& load : loads_) terms.push_back(load.get());
  for (const auto& load : toolLoads_) terms.push_back(load.get());
  if (stabilisation_) terms.push_back(stabilisation_.get());
  return terms;
}

template <int Dim>
Eigen::VectorXd Model<Dim>::target(double t) const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(numUnknowns_);
  supports_.setValues(t, values);
  return values - origin_;
}

template <int Dim>
SteppingState Model<Dim>::startState() const {
  SteppingState start;
  start.time = startTime_;
  start.x = start_;
  return start;
}

template <int Dim>
double Model<Dim>::forceFloor() const {
  return kForceFloor * youngsModulus(bulk_->material()) *
         std::pow(body_.size(), body_.axisymmetric ? 2 : Dim - 1);
}

template <int Dim>
ResidualScales Model<Dim>::residualScales() const {
  const double L = body_.size();
  ResidualScales scales;
  scales.numForces = numForces_;
  scales.forceFloor = forceFloor();
  scales.spanSizes = Eigen::VectorXd::Zero(numForces_);
  for (const auto& span : quadrature_->spans())
    for (const int node : span.nodes) {
      auto sizes = scales.spanSizes.segment<Dim>(Dim * node);
      sizes = sizes.cwiseMax(span.size);
    }
  scales.constraints.resize(numUnknowns_ - numForces_);
  Eigen::Index next = 0;
  for (const auto& pair : contacts_) {
    scales.constraints.segment(next, pair.term->numMultipliers()) =
        L * pair.term->weights().head(pair.term->numMultipliers());
    next += pair.term->numMultipliers();
  }
  for (const auto& contact : selfContacts_) {
    scales.constraints.segment(next, contact.term->numMultipliers()) = L * contact.term->weights();
    next += contact.term->numMultipliers();
  }
  return scales;
}

template <int Dim>
std::unique_ptr<Model<Dim>> buildModel(const Scene& scene) {
  try {
    return std::make_unique<Model<Dim>>(scene);
  } catch (const InputError& error) {
    throw Error(textWithPlaces(scene, error.problems()));
  }
}

template class Model<2>;
template class Model<3>;
template std::unique_ptr<Model<2>> buildModel(const Scene&);
template std::unique_ptr<Model<3>> buildModel(const Scene&);

}  // namespace burnish
