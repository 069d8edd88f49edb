#include "engine/analysis/choose_mesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "engine/analysis/carry_over.h"
#include "engine/analysis/contact_fit.h"
#include "engine/analysis/settle.h"
#include "engine/rezoning/curve.h"

namespace burnish {
namespace {

/// Lengths that the scene leaves out, see `meshChoice`.
constexpr double kTravel = 0.16;
constexpr double kAhead = 0.4;
constexpr double kBehind = 0.1;
constexpr double kRounding = 0.06;

/// Factors of the growth of knot spans that are tried until a mesh is sound: the faster they grow, the finer
/// they are around the contact, where the face turns sharply.
constexpr std::array kGrowths{1.0, 1.6, 2.4};

/// Of the smallest span: how far control points may be shifted so that a new mesh begins in contact.
constexpr double kShiftShare = 0.25;

double smallestThickness(const Model<2>& model) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& pair : model.contacts())
    smallest = std::min(smallest, model.tools()[pair.tool]->shape.halfThickness());
  return smallest;
}

/// Parameters of the quadrature points of a contact face.
Eigen::VectorXd parametersOf(const FaceQuadrature<2>& face) {
  Eigen::VectorXd parameters(face.numPoints());
  for (const auto& span : face.spans()) parameters.segment(span.firstPoint, span.xi.cols()) = span.xi.row(0);
  return parameters;
}

/// Where the tools press on the face, or are nearest to it.
struct ContactPlace {
  ArcInterval interval;    ///< along the face, by arc length
  double direction = 1.0;  ///< in which the tools move along the face: 1 towards its end, else -1
};

ContactPlace findContact(const Simulation<2>& simulation, const ArcLengthCurve& face,
                         const std::vector<ToolPose>& before) {
  ContactPlace place{{std::numeric_limits<double>::infinity(), 0.0}, 1.0};
  double nearest = std::numeric_limits<double>::infinity(), nearestParameter = 0.0;
  std::size_t tool = 0;
  for (const auto& pair : simulation.model->contacts()) {
    const ContactState& state = pair.term->state();
    const Eigen::VectorXd parameters = parametersOf(pair.term->face());
    for (Eigen::Index point = 0; point < parameters.size(); ++point) {
      if (state.gap(point) < nearest) {
        nearest = state.gap(point);
        nearestParameter = parameters(point);
        tool = pair.tool;
      }
      if (state.pressure(point) == 0.0) continue;
      place.interval.begin = std::min(place.interval.begin, face.lengthTo(parameters(point)));
      place.interval.end = std::max(place.interval.end, face.lengthTo(parameters(point)));
    }
  }
  if (place.interval.begin > place.interval.end) {
    const double s = face.lengthTo(nearestParameter);
    place.interval = {s, s};
  }
  const Eigen::Vector3d moved = simulation.toolPoses()[tool].displacement - before[tool].displacement;
  const double middle = 0.5 * (place.interval.begin + place.interval.end);
  if (moved.head<2>().dot(face.tangentAt(middle)) < 0.0) place.direction = -1.0;
  return place;
}

RemeshOptions remeshOptions(const MeshChoice& choice, const Simulation<2>& simulation,
                            const Patch<2>& deformed, const std::vector<ToolPose>& before) {
  const ArcLengthCurve face(tracePatch(deformed, choice.face));
  const ContactPlace place = findContact(simulation, face, before);
  const bool towardsEnd = place.direction > 0.0;
  const RezoningOptions& wanted = choice.options;
  RemeshOptions options;
  options.face = choice.face;
  options.finest = {place.interval.begin - (towardsEnd ? choice.behind : choice.ahead),
                    place.interval.end + (towardsEnd ? choice.ahead : choice.behind)};
  options.mesh = wanted.mesh;
  options.rounding = choice.rounding;
  for (std::size_t d = 0; d < 2; ++d)
    options.spans[d] =
        wanted.spans.empty() ? deformed.basis().direction(static_cast<int>(d)).numSpans() : wanted.spans[d];
  return options;
}

/// The new mesh so that it begins in contact, or as it is where that is not found.
Patch<2> inContact(const MeshChoice& choice, const Simulation<2>& simulation, const Patch<2>& deformed,
                   const Remeshing& meshing) {
  const Model<2>& model = *simulation.model;
  const auto poses = simulation.toolPoses();
  std::vector<RestingTool> resting;
  for (const auto& pair : model.contacts()) {
    auto contact = pair.term->options();
    contact.parameter = kSettlingStiffness * pair.term->parameter();
    resting.push_back({model.tools()[pair.tool].get(), poses[pair.tool], contact,
                       FaceCarryOver(model.body(), choice.face, deformed, meshing.patch)
                           .multipliers(pair.term->state().lambdaHat)});
  }
  ContactFitOptions options{.face = choice.face,
                            .axisymmetric = model.body().axisymmetric,
                            .farthest = kShiftShare * meshing.smallestSpan,
                            .smallestDeterminant = choice.options.mesh.smallestDeterminant};
  const auto functions = faceFunctions(deformed.basis(), choice.face);
  const std::array nodes{functions.front(), functions[1], functions.back()};
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (std::size_t d = 0; d < 2; ++d)
      options.held[k][d] = model.prescribed()[2 * static_cast<std::size_t>(nodes[k]) + d];
  return fittedToTools(meshing.patch, resting, options).value_or(meshing.patch);
}

}  // namespace

MeshChoice meshChoice(const Scene& scene, const Simulation<2>& initial) {
  const RezoningOptions& options = *scene.rezoning;
  const double length = std::min(smallestThickness(*initial.model), initial.model->body().size() / 6.0);
  return {.face = faceFromName<2>(scene.contact.front().place.face),
          .travel = options.travel.value_or(kTravel * length),
          .ahead = options.ahead.value_or(kAhead * length),
          .behind = options.behind.value_or(kBehind * length),
          .rounding = kRounding * length,
          .options = options};
}

std::optional<Remeshing> chooseMesh(const MeshChoice& choice, const Simulation<2>& simulation,
                                    const Patch<2>& deformed, const std::vector<ToolPose>& before) {
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

}  // namespace burnish
