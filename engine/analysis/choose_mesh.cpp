#include "engine/analysis/choose_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "engine/analysis/carry_over.h"
#include "engine/analysis/contact_fit.h"
#include "engine/analysis/settle.h"
#include "engine/core/error.h"
#include "engine/nurbs/arc_length_curve.h"
#include "engine/scene/path_of_tool.h"

namespace burnish::inline analysis {
namespace {

/// Lengths that the scene leaves out, see `meshChoice`.
constexpr double kTravel = 0.16;
constexpr double kAhead = 0.4;
constexpr double kBehind = 0.1;
constexpr double kRoundedShare = 0.06;

/// Factors of the growth of knot spans that are tried until a mesh is sound: the faster they grow, the finer
/// they are around the contact, where the face turns sharply.
constexpr std::array kGrowths{1.0, 1.6, 2.4};

/// Of the smallest span: how far control points may be shifted so that a new mesh begins in contact.
constexpr double kShiftShare = 0.25;

/// Of a face, among which the one nearest to a point of another body is sought.
constexpr int kSamplesPerSpan = 16;

/// The contacts of the face along which knot spans are distributed, but for tools that have left.
struct FaceContacts {
  std::vector<const ContactPair<2>*> tools;
  std::vector<std::size_t> pairs;  ///< their numbers
};

FaceContacts contactsOf(const Model<2>& model, const FacePlace& face) {
  FaceContacts contacts;
  for (const auto& pair : model.contacts())
    if (pair.place == face && !model.hasLeft(pair.tool)) contacts.tools.push_back(&pair);
  for (std::size_t k = 0; k < model.pairs().size(); ++k) {
    const FacePair<2>& pair = model.pairs()[k];
    if (pair.place == face || std::find(pair.against.begin(), pair.against.end(), face) != pair.against.end())
      contacts.pairs.push_back(k);
  }
  return contacts;
}

/// The face of the body in the first of the scene's contacts that it has one in.
FacePlace contactFace(const Scene& scene, const Model<2>& model, const ModelBody<2>& body) {
  for (const ContactSpec& contact : scene.contact) {
    std::vector<FaceSpec> faces{contact.place};
    faces.insert(faces.end(), contact.against.begin(), contact.against.end());
    for (const FaceSpec& face : faces)
      if (const FacePlace place = model.faces().face(face); &model.bodyOf(place) == &body) return place;
  }
  throw Error("rezoning: the body has no contact, which would tell where knot spans are needed");
}

/// Of the partners of the face: tools, and other bodies by half of their smaller extent.
double smallestThickness(const Model<2>& model, const ModelBody<2>& body, const FaceContacts& contacts) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ContactPair<2>* pair : contacts.tools)
    smallest = std::min(smallest, model.tools()[pair->tool]->shape.halfThickness());
  for (const std::size_t k : contacts.pairs) {
    Eigen::AlignedBox2d box;
    for (const auto& patch : otherBody(model, model.pairs()[k], body).body.patches)
      for (const auto& point : patch.points().colwise()) box.extend(Eigen::Vector2d(point));
    smallest = std::min(smallest, 0.5 * box.sizes().minCoeff());
  }
  return smallest;
}

std::vector<std::optional<ToolPath>> pathsOf(const Scene& scene) {
  std::vector<std::optional<ToolPath>> paths;
  for (const ToolSpec& tool : scene.tools)
    paths.push_back(tool.path ? std::optional(pathOf(tool)) : std::nullopt);
  return paths;
}

/// Parameters of the quadrature points of a contact face.
Eigen::VectorXd parametersOf(const FaceQuadrature<2>& face) {
  Eigen::VectorXd parameters(face.numPoints());
  for (const auto& span : face.spans()) parameters.segment(span.firstPoint, span.xi.cols()) = span.xi.row(0);
  return parameters;
}

/// Arc lengths of places on a curve that are nearest to points, among samples of it.
class NearestLengths {
 public:
  /// count: of the samples' intervals.
  NearestLengths(const ArcLengthCurve& curve, int count)
      : spacing_(curve.length() / count), samples_(2, count + 1) {
    for (int k = 0; k <= count; ++k) samples_.col(k) = curve.at(k * spacing_);
  }

  struct Nearest {
    double distance, length;
  };
  Nearest operator()(const Eigen::Vector2d& point) const {
    Eigen::Index k = 0;
    const double squared = (samples_.colwise() - point).colwise().squaredNorm().minCoeff(&k);
    return {std::sqrt(squared), spacing_ * static_cast<double>(k)};
  }

 private:
  double spacing_;
  Eigen::Matrix2Xd samples_;
};

/// Where tools and other bodies press on the face, or are nearest to it.
struct ContactPlace {
  ArcInterval interval;    ///< along the face, by arc length
  double direction = 1.0;  ///< in which they move along the face: 1 towards its end, else -1
};

/// Finds it from one point of a contact after the other.
class ContactSearch {
 public:
  /// travel: of the partner that the next points are of.
  void begin(const Eigen::Vector2d& travel) { travel_ = travel; }

  /// A point at an arc length with its distance from the partner, and whether it is pressed.
  void take(double length, double distance, bool isPressed) {
    if (distance < nearest_) {
      nearest_ = distance;
      nearestLength_ = length;
      nearestTravel_ = travel_;
    }
    if (!isPressed) return;
    pressed_.begin = std::min(pressed_.begin, length);
    pressed_.end = std::max(pressed_.end, length);
  }

  ContactPlace found(const ArcLengthCurve& face) const {
    ContactPlace place{pressed_, 1.0};
    if (pressed_.begin > pressed_.end) place.interval = {nearestLength_, nearestLength_};
    const double middle = 0.5 * (place.interval.begin + place.interval.end);
    if (nearestTravel_.dot(face.tangentAt(middle)) < 0.0) place.direction = -1.0;
    return place;
  }

 private:
  Eigen::Vector2d travel_ = Eigen::Vector2d::Zero(), nearestTravel_ = travel_;
  double nearest_ = std::numeric_limits<double>::infinity(), nearestLength_ = 0.0;
  ArcInterval pressed_{std::numeric_limits<double>::infinity(), 0.0};
};

/// Points of a pair of which the face is the slave, by their parameters; of which it is the master, by their
/// nearest places on it. Beyond the reach of the pair nothing is known of the other face but its control points.
void takePair(ContactSearch& search, const MeshChoice& choice, const Simulation<2>& simulation,
              const FacePair<2>& pair, const ArcLengthCurve& face) {
  const Model<2>& model = *simulation.model;
  const Eigen::VectorXd& x = simulation.stepping.state().x;
  const ContactState& state = pair.term->state();
  const auto& mesh = model.bodies()[choice.body].body.patches.front().basis();
  const NearestLengths nearest(face, kSamplesPerSpan * mesh.direction(1 - choice.place.face / 2).numSpans());
  const bool isSlave = pair.place == choice.place;
  const Eigen::VectorXd parameters = parametersOf(pair.term->face());
  const Eigen::Matrix2Xd positions = pair.term->face().positions(x);
  for (Eigen::Index q = 0; q < parameters.size(); ++q) {
    if (state.pressure(q) == 0.0) continue;
    search.take(isSlave ? face.lengthTo(parameters(q)) : nearest(positions.col(q)).length, state.gap(q),
                true);
  }
  const FacePlace other = isSlave ? pair.against.front() : pair.place;
  const auto patch = static_cast<std::size_t>(other.patch);
  const Body<2>& body = model.body();
  for (const int function : faceFunctions(body.patches[patch].basis(), other.face)) {
    const int node = body.nodes[patch][static_cast<std::size_t>(function)];
    const auto [distance, length] =
        nearest(body.patches[patch].points().col(function) + x.segment<2>(2 * Eigen::Index{node}));
    search.take(length, distance, false);
  }
}

ContactPlace findContact(const MeshChoice& choice, const Simulation<2>& simulation,
                         const ArcLengthCurve& face, const PartnerPlaces& before) {
  const Model<2>& model = *simulation.model;
  const PartnerPlaces now = partnerPlaces(simulation, model.bodies()[choice.body]);
  const FaceContacts contacts = contactsOf(model, choice.place);
  ContactSearch search;
  for (const ContactPair<2>* pair : contacts.tools) {
    const auto& path = choice.paths[pair->tool];
    search.begin(path ? Eigen::Vector2d(path->wayAhead(simulation.stepping.state().time).head<2>())
                      : before.travelOfTool(pair->tool, now));
    const ContactState& state = pair->term->state();
    const Eigen::VectorXd parameters = parametersOf(pair->term->face());
    for (Eigen::Index point = 0; point < parameters.size(); ++point)
      search.take(face.lengthTo(parameters(point)), state.gap(point), state.pressure(point) != 0.0);
  }
  for (const std::size_t k : contacts.pairs) {
    search.begin(before.travelOfPair(k, now));
    takePair(search, choice, simulation, model.pairs()[k], face);
  }
  return search.found(face);
}

RemeshOptions remeshOptions(const MeshChoice& choice, const Simulation<2>& simulation,
                            const Patch<2>& deformed, const PartnerPlaces& before) {
  const ArcLengthCurve face(tracePatch(deformed, choice.place.face));
  const ContactPlace place = findContact(choice, simulation, face, before);
  const bool towardsEnd = place.direction > 0.0;
  const RezoningOptions& wanted = choice.options;
  RemeshOptions options;
  options.face = choice.place.face;
  options.finest = {place.interval.begin - (towardsEnd ? choice.behind : choice.ahead),
                    place.interval.end + (towardsEnd ? choice.ahead : choice.behind)};
  options.mesh = wanted.mesh;
  options.rounding = choice.rounding;
  for (std::size_t d = 0; d < 2; ++d)
    options.spans[d] =
        wanted.spans.empty() ? deformed.basis().direction(static_cast<int>(d)).numSpans() : wanted.spans[d];
  return options;
}

/// The new mesh so that it begins in contact with tools, or as it is where that is not found.
Patch<2> inContact(const MeshChoice& choice, const Simulation<2>& simulation, const Patch<2>& deformed,
                   const Remeshing& meshing) {
  const Model<2>& model = *simulation.model;
  const Body<2>& body = model.bodies()[choice.body].body;
  const auto poses = simulation.toolPoses();
  std::vector<RestingTool> resting;
  for (const ContactPair<2>* pair : contactsOf(model, choice.place).tools) {
    auto contact = pair->term->options();
    contact.parameter = kSettlingStiffness * pair->term->parameter();
    resting.push_back({model.tools()[pair->tool].get(), poses[pair->tool], contact,
                       FaceCarryOver(body, choice.place.face, deformed, meshing.patch)
                           .multipliers(pair->term->state().lambdaHat)});
  }
  ContactFitOptions options{.face = choice.place.face,
                            .axisymmetric = body.axisymmetric,
                            .farthest = kShiftShare * meshing.smallestSpan,
                            .smallestDeterminant = choice.options.mesh.smallestDeterminant};
  const auto functions = faceFunctions(deformed.basis(), choice.place.face);
  const std::array some{functions.front(), functions[1], functions.back()};
  for (std::size_t k = 0; k < some.size(); ++k) {
    const auto node = static_cast<std::size_t>(body.nodes.front()[static_cast<std::size_t>(some[k])]);
    for (std::size_t d = 0; d < 2; ++d) options.held[k][d] = model.prescribed()[2 * node + d];
  }
  return fittedToTools(meshing.patch, resting, options).value_or(meshing.patch);
}

}  // namespace

MeshChoice meshChoice(const Scene& scene, const Simulation<2>& initial) {
  const RezoningOptions& options = *scene.rezoning;
  const std::size_t number = scene.rezonedBody();
  const Model<2>& model = *initial.model;
  const ModelBody<2>& body = model.bodies()[number];
  const FacePlace place = contactFace(scene, model, body);
  const double length =
      std::min(smallestThickness(model, body, contactsOf(model, place)), body.body.size() / 6.0);
  return {.body = number,
          .place = place,
          .travel = options.travel.value_or(kTravel * length),
          .ahead = options.ahead.value_or(kAhead * length),
          .behind = options.behind.value_or(kBehind * length),
          .rounding = kRoundedShare * length,
          .options = options,
          .paths = pathsOf(scene)};
}

bool mayBeTouched(const MeshChoice& choice, const Simulation<2>& simulation) {
  const FaceContacts contacts = contactsOf(*simulation.model, choice.place);
  const double time = simulation.stepping.state().time;
  return !contacts.pairs.empty() || std::ranges::any_of(contacts.tools, [&](const ContactPair<2>* pair) {
    const auto& path = choice.paths[pair->tool];
    return !path || !path->isLifted(time);
  });
}

std::optional<Remeshing> chooseMesh(const MeshChoice& choice, const Simulation<2>& simulation,
                                    const Patch<2>& deformed, const PartnerPlaces& before) {
  RemeshOptions options = remeshOptions(choice, simulation, deformed, before);
  std::optional<Remeshing> meshing;
  for (const double factor : kGrowths) {
    options.mesh.growth = factor * choice.options.mesh.growth;
    meshing = remesh(deformed, options);
    if (meshing) break;
  }
  if (!meshing) return std::nullopt;
  const Patch<2> fitted = inContact(choice, simulation, deformed, *meshing);
  meshing->boundaryError += (fitted.points() - meshing->patch.points()).colwise().norm().maxCoeff();
  meshing->patch = fitted;
  meshing->quality = meshQuality(meshing->patch);
  return meshing;
}

}  // namespace burnish::inline analysis
