#include "engine/analysis/rezoner.h"

#include <utility>

#include "engine/analysis/archive_body.h"
#include "engine/analysis/deformed_patch.h"
#include "engine/analysis/frames.h"
#include "engine/analysis/release_end.h"

namespace burnish::inline analysis {
namespace {

/// Reference positions of the body's own nodes, 2 x nodes.
Eigen::MatrixXd ownPositions(const Body<2>& body) {
  const auto [first, end] = body.nodeRange();
  return body.nodePositions().middleCols(first, end - first);
}

}  // namespace

Rezoner::Rezoner(const Scene& scene, const Simulation<2>& initial, const Team& team)
    : MeshRenewal<2>(scene, scene.rezonedBody(), initial, team),
      choice_(meshChoice(scene, initial)),
      trigger_(choice_.options, choice_.body, choice_.travel, initial),
      origin_(ownPositions(bodyOf(initial).body)) {}

bool Rezoner::isDue(const Simulation<2>& simulation) const {
  return !isReleasing(scene(), simulation.stepping.state().time) && mayBeTouched(choice_, simulation) &&
         trigger_.isDue(simulation);
}

std::unique_ptr<Simulation<2>> Rezoner::rezone(Simulation<2>& simulation) {
  auto next = tried(simulation, [&] { return attempt(simulation); });
  trigger_.noteAttempt(simulation, next != nullptr);
  return next;
}

std::unique_ptr<Simulation<2>> Rezoner::attempt(Simulation<2>& simulation) {
  const Patch<2> deformed = deformedPatch(bodyOf(simulation).body, simulation.stepping.state().x);
  const auto mesh = chooseMesh(choice_, simulation, deformed, trigger_.lastPlaces());
  if (!mesh) {
    fail(simulation, "no mesh of the deformed body is sound");
    return nullptr;
  }
  const CarryOver carried(simulation, choice_.body, deformed, *mesh,
                          scene().allBodies()[choice_.body].quadraturePoints.value_or(0));
  auto next =
      continuedOn(simulation, carried.body(), [&](const Model<2>& model) { return carried.startOf(model); },
                  {mesh->boundaryError, mesh->quality, mesh->smallestSpan});
  if (!next) return nullptr;
  const auto [first, end] = bodyOf(*next).body.nodeRange();
  origin_ = next->projections[choice_.body]
                .project(carried.atQuadraturePoints(origin_))
                .transpose()
                .middleCols(first, end - first);
  return next;
}

std::optional<MeshRecord> Rezoner::frameMesh(const Simulation<2>& simulation,
                                             Eigen::MatrixXd& displacement) const {
  if (records().empty()) return std::nullopt;
  const ModelBody<2>& body = bodyOf(simulation);
  const auto [first, end] = body.body.nodeRange();
  displacement.middleCols(first, end - first) += ownPositions(body.body) - origin_;
  MeshRecord mesh = meshRecord(*simulation.model);
  mesh.patches[static_cast<std::size_t>(body.firstPatch)].points = origin_;
  return mesh;
}

void Rezoner::archive(StateArchive& archive) {
  archive.part("trigger", trigger_);
  MeshRenewal<2>::archive(archive);
  if (!records().empty()) archiveMatrix(archive, "origin", 2, origin_);
}

}  // namespace burnish::inline analysis
