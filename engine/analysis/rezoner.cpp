#include "engine/analysis/rezoner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/analysis/contact_fit.h"
#include "engine/analysis/frames.h"
#include "engine/core/error.h"
#include "engine/rezoning/inverse_map.h"
#include "engine/solid/span_quadrature.h"

namespace burnish {
namespace {

/// Lengths that the scene leaves out, in parts of the smaller of the tool's half thickness and a sixth of the
/// body's size.
constexpr double kTravel = 0.16;
constexpr double kAhead = 0.4;
constexpr double kBehind = 0.1;
constexpr double kRounding = 0.06;

/// After a rezoning the step begins at a quarter of the nominal one; after one that failed, the next is tried
/// after a quarter of the travel.
constexpr int kLevelAfterwards = 2;
constexpr double kShareToNextTry = 0.25;

/// Circumference over the body's size below which a point is on the axis.
constexpr double kOnAxis = 1e-9;

/// Factors of the growth of knot spans that are tried until a mesh is sound: the faster they grow, the finer
/// they are around the contact, where the face turns sharply.
constexpr std::array kGrowths{1.0, 1.6, 2.4};

/// Of the smallest span: how far a new mesh may be from the old body, and how far its control points may be
/// shifted so that it begins in contact.
constexpr double kFarthestShare = 0.5;
constexpr double kShiftShare = 0.25;

/// Parts in which the gaps with which a simulation begins are taken away, until one way leads to equilibrium.
constexpr std::array kRamps{1, 4, 16};

/// By this factor the augmentation parameter is larger until then: with multipliers that are only guessed,
/// it is the gaps that tell rightly which control points are in contact.
constexpr double kStiffer = 200.0;

Patch<2> deformedPatch(const Patch<2>& patch, const Eigen::VectorXd& x) {
  const Eigen::Index n = patch.points().cols();
  return {patch.basis(), patch.points() + x.head(2 * n).reshaped(2, n), patch.weights()};
}

/// Value at a parameter of the field with these coefficients, components x nodes.
Eigen::VectorXd valueAt(const Patch<2>& patch, const Eigen::MatrixXd& coefficients,
                        const Eigen::Vector2d& xi) {
  const int span = patch.findSpan(xi);
  return coefficients(Eigen::all, patch.basis().spanFunctions(span)) * patch.shape(span, xi).R;
}

Eigen::Matrix2Xd anchorPositions(const Patch<2>& patch) {
  const auto& basis = patch.basis();
  Eigen::Matrix2Xd positions(2, basis.numFunctions());
  for (int a = 0; a < basis.numFunctions(); ++a) positions.col(a) = patch.position(basis.anchor(a));
  return positions;
}

/// Parameters of the quadrature points of a contact face.
Eigen::VectorXd parametersOf(const FaceQuadrature<2>& face) {
  Eigen::VectorXd parameters(face.numPoints());
  for (const auto& span : face.spans()) parameters.segment(span.firstPoint, span.xi.cols()) = span.xi.row(0);
  return parameters;
}

void archiveBasis(StateArchive& archive, const std::string& name, std::optional<UnivariateBasis>& basis) {
  int degree = basis ? basis->degree() : 0;
  int isLagrange = basis && basis->family() == BasisFamily::Lagrange ? 1 : 0;
  std::vector<double> knots = basis ? basis->knots() : std::vector<double>{};
  archive.field(name + "degree", degree);
  archive.field(name + "is_lagrange", isLagrange);
  archive.field(name + "knots", knots);
  if (!archive.restores()) return;
  basis = isLagrange == 1 ? UnivariateBasis::lagrange(degree, knots)
                          : UnivariateBasis::bspline(KnotVector(degree, knots));
}

/// Columns as one list of values.
void archiveMatrix(StateArchive& archive, const std::string& name, Eigen::Index rows,
                   Eigen::MatrixXd& matrix) {
  Eigen::VectorXd values = matrix.reshaped();
  archive.field(name, values);
  if (values.size() % rows != 0) throw Error(fmt::format("the saved {} is not that of a mesh", name));
  matrix = values.reshaped(rows, values.size() / rows).eval();
}

void archiveStates(StateArchive& archive, PointStates& states) {
  Eigen::MatrixXd b_e(9, std::ssize(states.b_e));
  for (Eigen::Index k = 0; k < b_e.cols(); ++k)
    b_e.col(k) = states.b_e[static_cast<std::size_t>(k)].reshaped();
  archiveMatrix(archive, "b_e", 9, b_e);
  archive.field("e_p", states.e_p);
  if (!archive.restores()) return;
  if (b_e.cols() != std::ssize(states.e_p)) throw Error("the saved states are not those of one mesh");
  states.b_e.clear();
  for (Eigen::Index k = 0; k < b_e.cols(); ++k) states.b_e.emplace_back(b_e.col(k).reshaped(3, 3));
}

/// The body of one patch with its states; an empty one is filled from the archive.
void archiveBody(StateArchive& archive, std::optional<RezonedBody<2>>& body) {
  std::array<std::optional<UnivariateBasis>, 2> directions;
  Eigen::MatrixXd points;
  bool axisymmetric = false;
  if (body) {
    const Patch<2>& patch = body->named.body.patches.front();
    for (std::size_t d = 0; d < 2; ++d) directions[d] = patch.basis().direction(static_cast<int>(d));
    points = patch.points();
    axisymmetric = body->named.body.axisymmetric;
  } else {
    body.emplace();
  }
  int isAxisymmetric = axisymmetric ? 1 : 0;
  archiveBasis(archive, "first_", directions[0]);
  archiveBasis(archive, "second_", directions[1]);
  archiveMatrix(archive, "points", 2, points);
  archive.field("is_axisymmetric", isAxisymmetric);
  archive.field("time", body->time);
  archive.field("plastic_work", body->plasticWork);
  archiveStates(archive, body->states);
  if (!archive.restores()) return;
  const Eigen::Index n = points.cols();
  body->named = {makeBody(Patch<2>(TensorBasis<2>({*directions[0], *directions[1]}), std::move(points),
                                   Eigen::VectorXd::Ones(n))),
                 {{}}};
  body->named.body.axisymmetric = isAxisymmetric == 1;
}

double smallestThickness(const Model<2>& model) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& pair : model.contacts())
    smallest = std::min(smallest, halfThickness(model.tools()[pair.tool]->shape));
  return smallest;
}

struct Settlement {
  NewtonReport report;
  double gapWork = 0.0;  ///< see `RezoningRecord`
};

/// λ_A of all pairs of a simulation.
std::vector<Eigen::VectorXd> multipliersOf(const Simulation<2>& simulation) {
  std::vector<Eigen::VectorXd> multipliers;
  for (const auto& pair : simulation.model->contacts())
    multipliers.push_back(
        simulation.stepping.state().x.segment(pair.term->firstMultiplier(), pair.term->numMultipliers()));
  return multipliers;
}

/// Multipliers λ̂ of a face of a body of one patch per new reference area: what pressed on an old reference
/// area presses on the stretched one now. deformed: the old patch in its place; next: the new one.
Eigen::VectorXd transferredMultipliers(const Body<2>& body, FaceId face, const Patch<2>& deformed,
                                       const Patch<2>& next, const Eigen::VectorXd& lambdaHat) {
  const auto before = tracePatch(body.patches.front(), face), now = tracePatch(deformed, face);
  const auto newTrace = tracePatch(next, face);
  const ArcLengthCurve oldCurve(now), newCurve(newTrace);
  Eigen::VectorXd result(newTrace.basis().numFunctions());
  for (int a = 0; a < result.size(); ++a) {
    const double share = newCurve.lengthTo(newTrace.basis().direction(0).anchor(a)) / newCurve.length();
    const Eigen::Vector<double, 1> xi(oldCurve.parameterAt(share * oldCurve.length()));
    const int span = before.findSpan(xi);
    const auto shape = before.shape(span, xi);
    const double along = now.jacobian(xi).norm() / before.jacobian(xi).norm();
    const double ring = body.circumference(before.position(xi));
    const bool onAxis = ring < kOnAxis * body.size();  // where both stretches are the same
    const double around = onAxis ? along : body.circumference(now.position(xi)) / ring;
    const double stretch = body.axisymmetric ? along * around : along;
    const double lambda = shape.R.dot(lambdaHat(before.basis().spanFunctions(span))) / stretch;
    result(a) = std::min(0.0, lambda);
  }
  return result;
}

/// Calls f for every term of contact, with tools first.
template <class F>
void forEachContact(const Model<2>& model, const F& f) {
  for (const auto& pair : model.contacts()) f(*pair.term);
  for (const auto& contact : model.selfContacts()) f(*contact.term);
}

/// Brings a simulation into equilibrium while the gaps with which it begins, and which pairs in contact should not
/// have, are taken away in equal parts.
Settlement settle(Simulation<2>& simulation, int parts) {
  std::vector<Eigen::VectorXd> origins;
  Settlement result;
  NewtonReport& report = result.report;
  report.outcome = NewtonOutcome::Inadmissible;
  if (!simulation.evaluateHere().admissible) return result;
  for (const auto& pair : simulation.model->contacts()) {
    const Eigen::VectorXd& gaps = pair.term->state().averageGap;
    const auto toClose = gapsToClose(
        gaps,
        simulation.stepping.state().x.segment(pair.term->firstMultiplier(), pair.term->numMultipliers()),
        kStiffer * pair.term->options().parameter);
    origins.emplace_back(Eigen::VectorXd::Zero(gaps.size()))(toClose) = gaps(toClose);
  }
  std::vector<double> parameters;
  forEachContact(*simulation.model, [&](auto& term) {
    parameters.push_back(term.options().parameter);
    term.setParameter(kStiffer * parameters.back());
  });
  int iterations = 0;
  std::vector<Eigen::VectorXd> before = multipliersOf(simulation);
  for (int left = parts - 1; left >= 0; --left) {
    for (std::size_t k = 0; k < origins.size(); ++k)
      simulation.model->contacts()[k].term->countGapsFrom(
          left == 0 ? Eigen::VectorXd() : Eigen::VectorXd(origins[k] * left / parts));
    report = simulation.stepping.settle();
    iterations += report.iterations;
    if (report.outcome != NewtonOutcome::Converged) break;
    std::vector<Eigen::VectorXd> now = multipliersOf(simulation);
    for (std::size_t k = 0; k < origins.size(); ++k)
      result.gapWork += simulation.model->contacts()[k].term->weights().dot(
          (0.5 / parts * (before[k] + now[k])).cwiseProduct(origins[k]));
    before = std::move(now);
  }
  auto parameter = parameters.begin();
  forEachContact(*simulation.model, [&](auto& term) { term.setParameter(*parameter++); });
  report.iterations = iterations;
  return result;
}

}  // namespace

Rezoner::Rezoner(const Scene& scene, const Simulation<2>& initial)
    : scene_(scene),
      spec_(*scene.rezoning),
      face_(faceFromName<2>(scene.contact.front().place.face)),
      length_(std::min(smallestThickness(*initial.model), initial.model->body().size() / 6.0)),
      travel_(spec_.travel.value_or(kTravel * length_)),
      volume_(initial.model->bulk().weights().sum()),
      last_(posesOf(initial)),
      wait_(travel_),
      origin_(initial.model->body().nodePositions()) {}

std::vector<ToolPose> Rezoner::posesOf(const Simulation<2>& simulation) const {
  std::vector<ToolPose> poses;
  const auto& state = simulation.stepping.state();
  for (const auto& tool : simulation.model->tools())
    poses.push_back(tool->pose(std::max(0.0, state.time), state.x));
  return poses;
}

double Rezoner::travelSince(const Simulation<2>& simulation) const {
  const auto poses = posesOf(simulation);
  double travel = 0.0;
  for (const auto& pair : simulation.model->contacts())
    travel = std::max(travel, (poses[pair.tool].displacement - last_[pair.tool].displacement).norm());
  return travel;
}

bool Rezoner::isDue(const Simulation<2>& simulation) const {
  if (simulation.recorder.crossesItself()) return false;
  constexpr double kAlmost = 1.0 - 1e-9;  // steps that land on the travel, but for rounding
  if (travelSince(simulation) >= kAlmost * wait_) return true;
  if (failedLast_) return false;
  const auto& x = simulation.stepping.state().x;
  if (simulation.model->bulk().largestStretch(x) > spec_.stretch) return true;
  return spec_.quality > 0.0 &&
         meshQuality(deformedPatch(simulation.model->body().patches.front(), x)) < spec_.quality;
}

Rezoner::Place Rezoner::findContact(const Simulation<2>& simulation, const ArcLengthCurve& face) const {
  const Model<2>& model = *simulation.model;
  Place place{{std::numeric_limits<double>::infinity(), 0.0}, 1.0};
  double nearest = std::numeric_limits<double>::infinity(), nearestPlace = 0.0;
  std::size_t tool = 0;
  for (const auto& pair : model.contacts()) {
    const ContactState& state = pair.term->state();
    const Eigen::VectorXd parameters = parametersOf(pair.term->face());
    for (Eigen::Index point = 0; point < parameters.size(); ++point) {
      if (state.gap(point) < nearest) {
        nearest = state.gap(point);
        nearestPlace = parameters(point);
        tool = pair.tool;
      }
      if (state.pressure(point) == 0.0) continue;
      place.contact.begin = std::min(place.contact.begin, face.lengthTo(parameters(point)));
      place.contact.end = std::max(place.contact.end, face.lengthTo(parameters(point)));
    }
  }
  if (place.contact.begin > place.contact.end) {
    const double s = face.lengthTo(nearestPlace);
    place.contact = {s, s};
  }
  const Eigen::Vector3d moved = posesOf(simulation)[tool].displacement - last_[tool].displacement;
  const double middle = 0.5 * (place.contact.begin + place.contact.end);
  if (moved.head<2>().dot(face.tangentAt(middle)) < 0.0) place.direction = -1.0;
  return place;
}

RemeshOptions Rezoner::options(const Simulation<2>& simulation, const Patch<2>& deformed) const {
  const ArcLengthCurve face(tracePatch(deformed, face_));
  const Place place = findContact(simulation, face);
  const double ahead = spec_.ahead.value_or(kAhead * length_),
               behind = spec_.behind.value_or(kBehind * length_);
  RemeshOptions options;
  options.face = face_;
  options.finest = {place.contact.begin - (place.direction > 0.0 ? behind : ahead),
                    place.contact.end + (place.direction > 0.0 ? ahead : behind)};
  options.growth = {spec_.growth, kRounding * length_};
  for (std::size_t d = 0; d < 2; ++d)
    options.spans[d] =
        spec_.spans.empty() ? deformed.basis().direction(static_cast<int>(d)).numSpans() : spec_.spans[d];
  options.turn = spec_.turn;
  options.firstLayer = spec_.firstLayer;
  options.smallestDeterminant = spec_.smallestDeterminant;
  return options;
}

void Rezoner::setMultipliers(const Simulation<2>& simulation, const Patch<2>& deformed, const Model<2>& next,
                             Eigen::VectorXd& x) const {
  const Model<2>& model = *simulation.model;
  const auto set = [&](const auto& oldTerm, const auto& newTerm, FaceId face) {
    x.segment(newTerm.firstMultiplier(), newTerm.numMultipliers()) = transferredMultipliers(
        model.body(), face, deformed, next.body().patches.front(), oldTerm.state().lambdaHat);
  };
  for (std::size_t k = 0; k < next.contacts().size(); ++k)
    set(*model.contacts()[k].term, *next.contacts()[k].term, face_);
  for (std::size_t k = 0; k < next.selfContacts().size(); ++k)
    set(*model.selfContacts()[k].term, *next.selfContacts()[k].term, next.selfContacts()[k].face);
}

/// The new mesh so that it begins in contact, or as it is where that is not found.
Patch<2> Rezoner::inContact(const Simulation<2>& simulation, const Patch<2>& deformed,
                            const Remeshing& meshing) const {
  const Model<2>& model = *simulation.model;
  const auto poses = posesOf(simulation);
  std::vector<RestingTool> resting;
  for (std::size_t k = 0; k < model.contacts().size(); ++k) {
    const auto& pair = model.contacts()[k];
    auto contact = pair.term->options();
    contact.parameter *= kStiffer;
    resting.push_back(
        {model.tools()[pair.tool].get(), poses[pair.tool], contact,
         transferredMultipliers(model.body(), face_, deformed, meshing.patch, pair.term->state().lambdaHat)});
  }
  ContactFitOptions options{.face = face_,
                            .axisymmetric = model.body().axisymmetric,
                            .farthest = kShiftShare * meshing.smallestSpan,
                            .smallestDeterminant = spec_.smallestDeterminant};
  const auto functions = faceFunctions(deformed.basis(), face_);
  const std::array nodes{functions.front(), functions[1], functions.back()};
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (std::size_t d = 0; d < 2; ++d)
      options.held[k][d] = model.prescribed()[2 * static_cast<std::size_t>(nodes[k]) + d];
  return fittedToTools(meshing.patch, resting, options).value_or(meshing.patch);
}

SteppingState Rezoner::startOn(const Simulation<2>& simulation, const Patch<2>& deformed,
                               const Model<2>& next, const Eigen::Matrix2Xd& anchors) const {
  const SteppingState& before = simulation.stepping.state();
  SteppingState start = before;
  start.x = Eigen::VectorXd::Zero(next.numUnknowns());
  setMultipliers(simulation, deformed, next, start.x);
  start.level = std::max(before.level, kLevelAfterwards);
  start.easySteps = 0;
  start.lastIncrement.resize(0);
  if (before.lastIncrement.size() == 0) return start;
  start.lastIncrement = Eigen::VectorXd::Zero(next.numUnknowns());
  const Eigen::MatrixXd increments = before.lastIncrement.head(simulation.model->numDisplacements())
                                         .reshaped(2, simulation.model->body().numNodes);
  for (Eigen::Index a = 0; a < anchors.cols(); ++a)
    start.lastIncrement.segment<2>(2 * a) = valueAt(deformed, increments, anchors.col(a));
  return start;
}

std::unique_ptr<Simulation<2>> Rezoner::rezone(Simulation<2>& simulation) {
  // Evaluated with the partners in self-contact as they are now, as a resumed run does.
  const bool isAdmissible = simulation.evaluateHere().admissible;
  if (!isAdmissible) fail(simulation, "its state cannot be evaluated again");
  std::unique_ptr<Simulation<2>> next;
  try {
    if (isAdmissible) next = attempt(simulation);
  } catch (const Error& error) {
    fail(simulation, error.what());
  }
  last_ = posesOf(simulation);
  failedLast_ = next == nullptr;
  wait_ = failedLast_ ? kShareToNextTry * travel_ : travel_;
  return next;
}

std::unique_ptr<Simulation<2>> Rezoner::attempt(Simulation<2>& simulation) {
  const auto& state = simulation.stepping.state();
  const Patch<2> deformed = deformedPatch(simulation.model->body().patches.front(), state.x);
  RemeshOptions wanted = options(simulation, deformed);
  std::optional<Remeshing> meshing;
  for (const double factor : kGrowths) {
    wanted.growth.slope = factor * spec_.growth;
    meshing = remesh(deformed, wanted);
    if (meshing) break;
  }
  if (!meshing) {
    fail(simulation, "no mesh of the deformed body is sound");
    return nullptr;
  }
  const Patch<2> fitted = meshing->patch;
  meshing->patch = inContact(simulation, deformed, *meshing);
  meshing->boundaryError += (meshing->patch.points() - fitted.points()).colwise().norm().maxCoeff();
  meshing->quality = meshQuality(meshing->patch);

  RezonedBody<2> body{
      {makeBody(meshing->patch), {{}}}, {}, simulation.model->bulk().plasticWork(), state.time};
  body.named.body.axisymmetric = simulation.model->body().axisymmetric;
  const SpanQuadrature<2> quadrature(body.named.body, scene_.quadraturePoints.value_or(0));
  const InverseMap map(deformed);
  const double farthest = kFarthestShare * meshing->smallestSpan;
  const Eigen::Matrix2Xd parameters = parametersIn(map, pointPositions(quadrature, meshing->patch), farthest);
  const auto& history = simulation.model->bulk().history();
  PointStates states{simulation.model->bulk().elasticDeformation(state.x), {}};
  for (const auto& point : history) states.e_p.push_back(point.e_p);
  body.states = interpolated(simulation.model->quadrature(), deformed.basis(), states, parameters);

  const Eigen::Matrix2Xd anchors = parametersIn(map, anchorPositions(meshing->patch), farthest);
  Settlement settlement;
  std::unique_ptr<Simulation<2>> next;
  long failedIterations = 0;
  for (const int ramp : kRamps) {
    auto model = std::make_unique<Model<2>>(scene_, body);
    SteppingState start = startOn(simulation, deformed, *model, anchors);
    start.iterations += failedIterations;
    next = std::make_unique<Simulation<2>>(scene_, std::move(model), std::move(start));
    settlement = settle(*next, ramp);
    if (settlement.report.outcome == NewtonOutcome::Converged) break;
    failedIterations += settlement.report.iterations;
  }
  const NewtonReport& report = lastReport_ = settlement.report;
  if (report.outcome != NewtonOutcome::Converged) {
    fail(simulation, fmt::format("no equilibrium on a new mesh of quality {:.2g}, {}", meshing->quality,
                                 describe(report.outcome)));
    return nullptr;
  }
  next->recorder.continueFrom(simulation.recorder);
  next->record();

  Eigen::MatrixXd origin(parameters.cols(), 2);
  for (Eigen::Index k = 0; k < parameters.cols(); ++k)
    origin.row(k) = valueAt(deformed, origin_, parameters.col(k)).transpose();
  origin_ = next->projection.project(origin).transpose();
  body_ = std::move(body);
  records_.push_back(
      {.time = state.time,
       .energyLost = simulation.recorder.current().strainEnergy - next->recorder.current().strainEnergy,
       .gapWork = settlement.gapWork,
       .volumeDrift = next->model->bulk().weights().sum() / volume_ - 1.0,
       .boundaryError = meshing->boundaryError,
       .quality = meshing->quality,
       .smallestSpan = meshing->smallestSpan,
       .iterations = report.iterations});
  next->recorder.noteRezoning(records_.back());
  return next;
}

void Rezoner::fail(const Simulation<2>& simulation, const std::string& why) {
  ++numFailures_;
  lastFailure_ = fmt::format("t = {:.6g}: {}", simulation.stepping.state().time, why);
}

std::optional<MeshRecord> Rezoner::frameMesh(const Simulation<2>& simulation,
                                             Eigen::MatrixXd& displacement) const {
  if (records_.empty()) return std::nullopt;
  displacement += simulation.model->body().nodePositions() - origin_;
  MeshRecord mesh = meshRecord(simulation.model->body());
  mesh.patches.front().points = origin_;
  return mesh;
}

void Rezoner::archive(StateArchive& archive) {
  for (std::size_t k = 0; k < last_.size(); ++k) {
    archive.field(fmt::format("tool{}_displacement", k), last_[k].displacement);
    archive.field(fmt::format("tool{}_angle", k), last_[k].angle);
  }
  archive.field("wait", wait_);
  int failedLast = failedLast_ ? 1 : 0;
  archive.field("failed_last", failedLast);
  failedLast_ = failedLast == 1;
  archive.field("failures", numFailures_);
  archiveRecords(archive);
  if (records_.empty()) return;
  archiveMatrix(archive, "origin", 2, origin_);
  archiveBody(archive, body_);
}

void Rezoner::archiveRecords(StateArchive& archive) {
  constexpr Eigen::Index perRecord = 8;
  Eigen::MatrixXd values(perRecord, std::ssize(records_));
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    const auto& r = records_[static_cast<std::size_t>(k)];
    values.col(k) << r.time, r.energyLost, r.gapWork, r.volumeDrift, r.boundaryError, r.quality,
        r.smallestSpan, r.iterations;
  }
  archiveMatrix(archive, "records", perRecord, values);
  records_.clear();
  for (const auto& r : values.colwise())
    records_.push_back({r(0), r(1), r(2), r(3), r(4), r(5), r(6), static_cast<int>(r(7))});
}

std::unique_ptr<Simulation<2>> Rezoner::restoredSimulation() const {
  if (!body_) return nullptr;
  auto model = std::make_unique<Model<2>>(scene_, *body_);
  SteppingState start;
  start.time = body_->time;
  start.x = Eigen::VectorXd::Zero(model->numUnknowns());
  return std::make_unique<Simulation<2>>(scene_, std::move(model), std::move(start));
}

}  // namespace burnish
