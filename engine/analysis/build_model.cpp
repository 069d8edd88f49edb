#include "engine/analysis/build_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/analysis/check_model.h"
#include "engine/analysis/geometry_check.h"
#include "engine/analysis/initial_state.h"
#include "engine/analysis/place_tools.h"
#include "engine/analysis/release_end.h"
#include "engine/analysis/tools.h"
#include "engine/contact/face_partner.h"
#include "engine/contact/partner_contact.h"
#include "engine/core/input_error.h"
#include "engine/core/key_error.h"
#include "engine/scene/scene_places.h"
#include "engine/solid/dead_load.h"
#include "engine/solid/deformation_gradients.h"
#include "engine/solid/follower_load.h"
#include "engine/solid/point_count.h"

namespace burnish::inline analysis {
/// Fills a model part by part: first the body, then loads and tools, then contact pairs, whose multipliers
/// come last among the unknowns.
template <int Dim>
class ModelBuilder {
 public:
  /// The body of the scene, at rest and free of stress, with all that is checked once.
  static std::unique_ptr<Model<Dim>> build(const Scene& scene);

  /// One of the bodies with a history.
  static std::unique_ptr<Model<Dim>> rebuild(const Scene& scene, const RezonedBody<Dim>& rezoned);

 private:
  ModelBuilder(const Scene& scene, const std::vector<NamedBody<Dim>>& bodies)
      : scene_(scene), model_(new Model<Dim>(scene, bodies)), firstSize_(model_->body_.size()) {}

  static std::vector<NamedBody<Dim>> bodiesOf(const Scene& scene);

  /// Of the bodies as a run of the scene begins with them.
  static double firstSize(const Scene& scene);

  const SpanQuadrature<Dim>& addQuadrature(std::size_t body);
  void addBody(std::size_t number, const std::optional<ReferenceState>& reference);
  void addLoad(std::size_t number);
  void addTool(std::size_t number);
  void addContact(std::size_t number);
  void addPair(std::size_t number);

  std::unique_ptr<FaceContact<Dim>> partnerContact(const FacePlace& place, const std::string& key,
                                                   const PartnerMaker<Dim>& makePartner,
                                                   const ContactOptions& options);

  /// The faces of a surface as the partner of the face at a place. slave: its quadrature.
  std::unique_ptr<FacePartner<Dim>> facesAsPartner(const FaceQuadrature<Dim>& slave, const FacePlace& place,
                                                   const std::vector<FacePlace>& surface,
                                                   const PartnerRules& rules) const;

  void addSelfContact(std::size_t number);
  void addStabilisation();
  void addReleases();
  void addLeavingTool(std::size_t number);

  /// All unknowns are numbered.
  void closeNumbering();

  const Scene& scene_;
  std::unique_ptr<Model<Dim>> model_;
  double firstSize_;                           ///< in which turns of tools are measured, on every mesh
  const RezonedBody<Dim>* rezoned_ = nullptr;  ///< null for the scene's own bodies
};

template <int Dim>
std::unique_ptr<Model<Dim>> ModelBuilder<Dim>::build(const Scene& scene) {
  ModelBuilder builder(scene, bodiesOf(scene));
  Model<Dim>& model = *builder.model_;
  requireSoundGeometry(model, scene);
  InputProblems problems;
  for (std::size_t k = 0; k < model.bodies_.size(); ++k)
    problems.gather([&] {
      builder.addQuadrature(k);
      builder.addBody(k, initialState(scene, k, model.bodies_[k].body, *model.bodies_[k].quadrature));
    });
  problems.throwIfAny();
  for (std::size_t k = 0; k < scene.loads.size(); ++k)
    problems.gather([&] { placed(loadKey(scene, k), [&] { builder.addLoad(k); }); });
  for (std::size_t k = 0; k < scene.tools.size(); ++k) problems.gather([&] { builder.addTool(k); });
  problems.throwIfAny();
  for (std::size_t k = 0; k < scene.contact.size(); ++k)
    problems.gather([&] {
      if (!scene.contact[k].against.empty()) return;
      requireReachable(scene, model, scene.contact[k], fmt::format("contact[{}]", k));
      builder.addContact(k);
    });
  for (std::size_t k = 0; k < scene.contact.size(); ++k)
    if (!scene.contact[k].against.empty()) problems.gather([&] { builder.addPair(k); });
  for (std::size_t k = 0; k < scene.selfContact.size(); ++k)
    problems.gather([&] { builder.addSelfContact(k); });
  if (!scene.stabilise) problems.gather([&] { requireSupported(scene, model); });
  problems.gather([&] { requireHeldAxis(model); });
  problems.throwIfAny();
  builder.closeNumbering();
  requireFiniteFormulas(scene, model);
  model.start_ = placeTools(scene, model);
  builder.addReleases();
  builder.addStabilisation();
  return std::move(builder.model_);
}

template <int Dim>
std::unique_ptr<Model<Dim>> ModelBuilder<Dim>::rebuild(const Scene& scene, const RezonedBody<Dim>& rezoned) {
  const std::size_t number = scene.rezonedBody();
  std::vector<NamedBody<Dim>> bodies;
  for (std::size_t k = 0; k < scene.allBodies().size(); ++k)
    bodies.push_back(k == number ? rezoned.named : makeBody<Dim>(scene, k));
  ModelBuilder builder(scene, bodies);
  builder.rezoned_ = &rezoned;
  builder.firstSize_ = firstSize(scene);
  Model<Dim>& model = *builder.model_;
  const auto [firstNode, endNode] = model.bodies_[number].body.nodeRange();
  model.start_.time = rezoned.time;
  model.start_.x = Eigen::VectorXd::Zero(model.numDisplacements());
  model.start_.x.head(Dim * firstNode) = rezoned.others.leftCols(firstNode).reshaped();
  const Eigen::Index behind = rezoned.others.cols() - firstNode;
  model.start_.x.tail(Dim * behind) = rezoned.others.rightCols(behind).reshaped();
  const bool keepsReference = rezoned.displacement.size() > 0;
  const Eigen::Index first = Dim * firstNode, count = Dim * (endNode - firstNode);
  if (keepsReference) model.start_.x.segment(first, count) = rezoned.displacement.reshaped();
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const SpanQuadrature<Dim>& quadrature = builder.addQuadrature(k);
    std::optional<ReferenceState> reference;
    if (k != number) {
      reference = initialState(scene, k, model.bodies_[k].body, quadrature);
    } else {
      std::vector<Eigen::Matrix3d> gradients;
      if (keepsReference) gradients = deformationGradients(quadrature, model.start_.x);
      reference = referenceState(quadrature, rezoned.states, std::move(gradients));
      reference->plasticWork = rezoned.plasticWork;
    }
    builder.addBody(k, reference);
  }
  for (std::size_t k = 0; k < scene.loads.size(); ++k) builder.addLoad(k);
  for (std::size_t k = 0; k < scene.tools.size(); ++k) builder.addTool(k);
  for (std::size_t k = 0; k < scene.contact.size(); ++k)
    if (scene.contact[k].against.empty()) builder.addContact(k);
  for (std::size_t k = 0; k < scene.contact.size(); ++k)
    if (!scene.contact[k].against.empty()) builder.addPair(k);
  for (std::size_t k = 0; k < scene.selfContact.size(); ++k) builder.addSelfContact(k);
  builder.closeNumbering();
  model.start_.x.conservativeResizeLike(Eigen::VectorXd::Zero(model.numUnknowns()));
  if (keepsReference) {
    placeTools(scene, model);  // what the undeformed body says of them; where they are now is carried over
  } else {
    prepareTools(scene, model);
    Eigen::VectorXd values = model.origin_;
    model.supports_.setValues(rezoned.time, values);
    model.origin_.segment(first, count) = values.segment(first, count);
  }
  builder.addReleases();
  builder.addStabilisation();
  if (model.stabilisation_) model.stabilisation_->beginAt(model.start_.x);
  return std::move(builder.model_);
}

template <int Dim>
std::vector<NamedBody<Dim>> ModelBuilder<Dim>::bodiesOf(const Scene& scene) {
  std::vector<NamedBody<Dim>> bodies;
  InputProblems problems;
  for (std::size_t k = 0; k < scene.allBodies().size(); ++k)
    problems.gather([&] { bodies.push_back(makeBody<Dim>(scene, k)); });
  problems.throwIfAny();
  return bodies;
}

template <int Dim>
double ModelBuilder<Dim>::firstSize(const Scene& scene) {
  std::vector<Body<Dim>> bodies;
  for (const NamedBody<Dim>& one : bodiesOf(scene)) bodies.push_back(one.body);
  numberTogether(bodies);
  return unitedBody(bodies).size();
}

template <int Dim>
const SpanQuadrature<Dim>& ModelBuilder<Dim>::addQuadrature(std::size_t number) {
  ModelBody<Dim>& body = model_->bodies_[number];
  const BodySpec& spec = scene_.allBodies()[number];
  if (spec.quadraturePoints.value_or(spec.degree + 1) <= spec.degree &&
      !isHeldBy(*spec.quadraturePoints, body.body))
    throw InputError(scene_.bodyKey(number, "quadrature_points"),
                     fmt::format("found {} for a body with one knot span in a direction, or with knots that "
                                 "stand several times; allowed there: at least {}, the degree plus one.",
                                 *spec.quadraturePoints, spec.degree + 1));
  try {
    body.quadrature = std::make_unique<SpanQuadrature<Dim>>(body.body, spec.quadraturePoints.value_or(0));
  } catch (const InputError& error) {
    throw InputError(scene_.bodyKey(number, "geometry"), error.problems().front().text);
  }
  return *body.quadrature;
}

template <int Dim>
void ModelBuilder<Dim>::addBody(std::size_t number, const std::optional<ReferenceState>& reference) {
  ModelBody<Dim>& body = model_->bodies_[number];
  const BodySpec& spec = scene_.allBodies()[number];
  body.bulk = makeBulkTerm(body.body, *body.quadrature, MaterialLaws::make(spec.material), spec.formulation,
                           reference);
}

template <int Dim>
void ModelBuilder<Dim>::addLoad(std::size_t number) {
  const auto& load = scene_.loads[number];
  const Schedule factor = load.schedule.value_or(Schedule{});
  model_->corners_.insert(model_->corners_.end(), factor.times.begin(), factor.times.end());
  if (!load.bodyForce.empty()) {
    const ModelBody<Dim>& body = model_->bodies_[scene_.bodyNumber(load.place.body)];
    const int patch = load.place.patch.empty() ? -1 : model_->faces_.patch(load.place) - body.firstPatch;
    model_->loads_.push_back(std::make_unique<DeadLoad<Dim>>(
        body.body, *body.quadrature, patch, makeFormulas(load.bodyForce, scene_.definitions), factor));
    return;
  }
  model_->faces_.requireOuter(load.place, fmt::format("loads[{}]", number));
  const auto [patch, side] = model_->faces_.face(load.place);
  FaceQuadrature<Dim> face(model_->body_, patch, side, 0,
                           model_->faces_.part(load.place, fmt::format("loads[{}]", number)));
  if (!load.traction.empty()) {
    model_->loads_.push_back(std::make_unique<DeadLoad<Dim>>(
        model_->body_, face, makeFormulas(load.traction, scene_.definitions), factor));
    return;
  }
  const auto direction =
      load.pressure ? FollowerLoad<Dim>::Direction::Pressure : FollowerLoad<Dim>::Direction::Shear;
  model_->loads_.push_back(std::make_unique<FollowerLoad<Dim>>(
      model_->body_, patch, side, std::move(face), direction,
      Formula(load.pressure ? *load.pressure : *load.shear, scene_.definitions), factor));
}

template <int Dim>
void ModelBuilder<Dim>::addTool(std::size_t number) {
  const auto& spec = scene_.tools[number];
  try {
    model_->tools_.push_back(makeTool(spec, scene_, model_->numForces_, firstSize_));
  } catch (const KeyError& error) {
    throw InputError(fmt::format("tools[{}].{}", number, error.key()), error.what());
  } catch (const Error& error) {
    throw InputError(fmt::format("tools[{}]", number), error.what());
  }
  const Tool& tool = *model_->tools_.back();
  model_->numForces_ += static_cast<int>(tool.freeUnknowns().size());
  model_->numUnknowns_ = model_->numForces_;
  if (auto load = makeToolLoad(spec, scene_, tool, model_->body_.size()))
    model_->toolLoads_.push_back({number, std::move(load)});
  const auto corners = cornersOf(spec);
  model_->corners_.insert(model_->corners_.end(), corners.begin(), corners.end());
  if (spec.until) model_->corners_.insert(model_->corners_.end(), {*spec.until, releaseEnd(scene_, spec)});
}

template <int Dim>
void ModelBuilder<Dim>::addContact(std::size_t number) {
  const auto& spec = scene_.contact[number];
  const std::size_t tool = model_->toolNumber(spec.tool);
  const FacePlace place = model_->faces_.face(spec.place);
  ContactOptions options = spec.options;
  const ModelBody<Dim>& body = model_->bodyOf(place);
  const int patch = place.patch - body.firstPatch;
  options.parameter = options.parameterFor(
      youngsModulus(body.bulk->material()), body.body.size(),
      meanControlPointDistance(body.body.patches[static_cast<std::size_t>(patch)], place.face));
  auto term = makeToolContact<Dim>(body.body, patch, place.face, *model_->tools_[tool], options,
                                   model_->numUnknowns_, model_->supports_.prescribed(), scene_.definitions);
  model_->numUnknowns_ += term->numMultipliers();
  model_->contacts_.push_back({tool, place, std::move(term)});
}

/// Contact of a face with other faces, whose multipliers become the next unknowns.
template <int Dim>
std::unique_ptr<FaceContact<Dim>> ModelBuilder<Dim>::partnerContact(const FacePlace& place,
                                                                    const std::string& key,
                                                                    const PartnerMaker<Dim>& makePartner,
                                                                    const ContactOptions& options) {
  try {
    auto term =
        makePartnerContact<Dim>(model_->body_, place.patch, place.face, makePartner, options,
                                model_->numUnknowns_, model_->supports_.prescribed(), scene_.definitions);
    model_->numUnknowns_ += term->numMultipliers();
    return term;
  } catch (const InputError&) {
    throw;
  } catch (const Error& error) {
    throw InputError(key, error.what());
  }
}

template <int Dim>
std::unique_ptr<FacePartner<Dim>> ModelBuilder<Dim>::facesAsPartner(const FaceQuadrature<Dim>& slave,
                                                                    const FacePlace& place,
                                                                    const std::vector<FacePlace>& surface,
                                                                    const PartnerRules& rules) const {
  const auto& patch = model_->body_.patches[static_cast<std::size_t>(place.patch)];
  auto partner =
      std::make_unique<FacePartner<Dim>>(slave, tracePatch(patch, place.face), outwardSign(patch, place.face),
                                         MasterSurface<Dim>(model_->body_, surface), rules);
  if (rezoned_ != nullptr) partner->beginAt(rezoned_->time, model_->start_.x);
  return partner;
}

template <int Dim>
void ModelBuilder<Dim>::addPair(std::size_t number) {
  const auto& spec = scene_.contact[number];
  const std::string key = fmt::format("contact[{}]", number);
  model_->faces_.requireOuter(spec.place, key);
  const FacePlace place = model_->faces_.face(spec.place);
  const ModelBody<Dim>& body = model_->bodyOf(place);
  std::vector<FacePlace> against;
  double softest = youngsModulus(body.bulk->material()), smallest = body.body.size();
  for (std::size_t k = 0; k < spec.against.size(); ++k) {
    const FaceSpec& face = spec.against[k];
    model_->faces_.requireOuter(face, againstKey(spec, key, k));
    against.push_back(model_->faces_.face(face));
    const ModelBody<Dim>& other = model_->bodyOf(against.back());
    softest = std::min(softest, youngsModulus(other.bulk->material()));
    smallest = std::min(smallest, other.body.size());
  }
  ContactOptions options = spec.options;
  const auto& patch = model_->body_.patches[static_cast<std::size_t>(place.patch)];
  // At points gaps are weighed against tractions, which are those of the softer body.
  const double modulus = averagesGaps(options.method) ? youngsModulus(body.bulk->material()) : softest;
  options.parameter =
      options.parameterFor(modulus, body.body.size(), meanControlPointDistance(patch, place.face));
  const PartnerRules rules{.reach = spec.reach.value_or(defaultReach(body.body.size(), smallest)),
                           .largestSlip = options.hasFriction() ? kLargestSlip : kAnySlip,
                           .segments = spec.segments};
  GapRamp fit;
  const PartnerMaker<Dim> makePartner = [&](const FaceQuadrature<Dim>& slave) {
    auto partner = facesAsPartner(slave, place, against, rules);
    if (rezoned_ != nullptr) {
      fit = rezoned_->fits[model_->pairs_.size()];
      partner->resolveInterference(fit);
      return partner;
    }
    const double overlap = -partner->smallestGap();
    if (spec.interference == Interference::Resolve && overlap > 0.0) {
      fit = {overlap, model_->startTime(), scene_.steps.front().until};
      partner->resolveInterference(fit);
    } else {
      requireApart(*model_, overlap, spec, key);
    }
    return partner;
  };
  auto term = partnerContact(place, key, makePartner, options);
  if (fit.amount > 0.0) term->beginFrictionAt(fit.until);
  model_->pairs_.push_back({pairName(spec), place, against, std::move(term), fit});
}

template <int Dim>
void ModelBuilder<Dim>::addSelfContact(std::size_t number) {
  const auto& spec = scene_.selfContact[number];
  const std::string key = fmt::format("self_contact[{}]", number);
  std::vector<FacePlace> surface;
  for (const FaceSpec& face : spec.places()) {
    model_->faces_.requireOuter(face, key);
    surface.push_back(model_->faces_.face(face));
  }
  const ModelBody<Dim>& body = model_->bodyOf(surface.front());
  const double reach = spec.reach.value_or(defaultReach(body.body.size(), body.body.size()));
  for (std::size_t k = 0; k < surface.size(); ++k) {
    const FacePlace place = surface[k];
    const auto& patch = model_->body_.patches[static_cast<std::size_t>(place.patch)];
    ContactOptions options = spec.options;
    options.parameter = options.parameterFor(youngsModulus(body.bulk->material()), body.body.size(),
                                             meanControlPointDistance(patch, place.face));
    const PartnerMaker<Dim> makePartner = [&](const FaceQuadrature<Dim>& slave) {
      return facesAsPartner(slave, place, surface,
                            selfContactRules(reach, static_cast<int>(k), rezoned_ != nullptr));
    };
    model_->selfContacts_.push_back({place, reach, partnerContact(place, key, makePartner, options)});
  }
}

template <int Dim>
void ModelBuilder<Dim>::addReleases() {
  std::vector<ReleasedForces::Release> releases;
  for (std::size_t k = 0; k < scene_.supports.size(); ++k) {
    const SupportSpec& support = scene_.supports[k];
    if (!support.until) continue;
    const double end = releaseEnd(scene_, support);
    releases.push_back({*support.until, end, model_->supports_.owned(k)});
  }
  if (!releases.empty())
    model_->released_ = std::make_unique<ReleasedForces>(model_->numDisplacements(), std::move(releases));
  for (std::size_t k = 0; k < scene_.tools.size(); ++k)
    if (scene_.tools[k].until) addLeavingTool(k);
}

template <int Dim>
void ModelBuilder<Dim>::addLeavingTool(std::size_t number) {
  const ToolSpec& spec = scene_.tools[number];
  std::set<int> nodes;
  for (const auto& pair : model_->contacts_)
    if (pair.tool == number) nodes.insert(pair.term->face().nodes().begin(), pair.term->face().nodes().end());
  std::vector<int> unknowns;
  for (const int node : nodes)
    for (int d = 0; d < Dim; ++d) unknowns.push_back(Dim * node + d);
  std::vector<ReleasedForces::Release> release{{*spec.until, releaseEnd(scene_, spec), std::move(unknowns)}};
  model_->leaving_.push_back(
      {number, *spec.until,
       std::make_unique<ReleasedForces>(model_->numDisplacements(), std::move(release))});
}

template <int Dim>
void ModelBuilder<Dim>::addStabilisation() {
  if (!scene_.stabilise) return;
  const double end = scene_.stabilise->until.value_or(scene_.steps.front().until);
  model_->stabilisation_ = std::make_unique<Stabilisation<Dim>>(
      model_->body_.numNodes, typename Stabilisation<Dim>::Drag{model_->startTime(), end});
  for (const ModelBody<Dim>& body : model_->bodies_) {
    // η V (L / T) = strength E L (E L² in 3D)
    const double force = scene_.stabilise->strength * model_->forceFloorOf(body) / kForceFloor;
    const double viscosity = force * end / (body.quadrature->volume() * body.body.size());
    model_->stabilisation_->hold(*body.quadrature, viscosity);
  }
}

template <int Dim>
void ModelBuilder<Dim>::closeNumbering() {
  model_->prescribed_.resize(static_cast<std::size_t>(model_->numUnknowns_), false);
  model_->origin_ = Eigen::VectorXd::Zero(model_->numUnknowns_);
  std::vector<double>& corners = model_->corners_;
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
}

template <int Dim>
std::unique_ptr<Model<Dim>> buildModel(const Scene& scene) {
  try {
    return ModelBuilder<Dim>::build(scene);
  } catch (const InputError& error) {
    throw Error(textWithPlaces(scene, error.problems()));
  }
}

template <int Dim>
std::unique_ptr<Model<Dim>> rebuildModel(const Scene& scene, const RezonedBody<Dim>& rezoned) {
  return ModelBuilder<Dim>::rebuild(scene, rezoned);
}

template std::unique_ptr<Model<2>> buildModel(const Scene&);
template std::unique_ptr<Model<3>> buildModel(const Scene&);
template std::unique_ptr<Model<2>> rebuildModel(const Scene&, const RezonedBody<2>&);
template std::unique_ptr<Model<3>> rebuildModel(const Scene&, const RezonedBody<3>&);

}  // namespace burnish::inline analysis
