#include "engine/analysis/partner_places.h"

#include <fmt/format.h>

namespace burnish::inline analysis {
namespace {

/// Mean of the displacements by reference volume.
Eigen::Vector2d meanDisplacement(const ModelBody<2>& body, const Eigen::VectorXd& x) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double volume = 0.0;
  Eigen::MatrixXd buffer;
  for (const auto& span : body.quadrature->spans()) {
    const Eigen::VectorXd shares = span.values(buffer) * span.weights;
    for (std::size_t a = 0; a < span.nodes.size(); ++a)
      sum += shares(static_cast<Eigen::Index>(a)) * x.segment<2>(2 * Eigen::Index{span.nodes[a]});
    volume += span.weights.sum();
  }
  return sum / volume;
}

/// own: the mean displacement of the body.
PartnerPlaces placesBeside(const Simulation<2>& simulation, const ModelBody<2>& body,
                           const Eigen::Vector2d& own) {
  const Model<2>& model = *simulation.model;
  PartnerPlaces places{simulation.toolPoses(), {}};
  for (const FacePair<2>& pair : model.pairs()) {
    Eigen::Vector2d way = Eigen::Vector2d::Zero();
    if (model.touches(pair, body))
      way = meanDisplacement(otherBody(model, pair, body), simulation.stepping.state().x) - own;
    places.ways.push_back(way);
  }
  return places;
}

}  // namespace

void PartnerPlaces::archive(StateArchive& archive) {
  for (std::size_t k = 0; k < tools.size(); ++k) {
    archive.field(fmt::format("tool{}_displacement", k), tools[k].displacement);
    archive.field(fmt::format("tool{}_angle", k), tools[k].angle);
  }
  for (std::size_t k = 0; k < ways.size(); ++k)
    archive.together(fmt::format("pair{}_way", k), ways[k].x(), ways[k].y());
}

const ModelBody<2>& otherBody(const Model<2>& model, const FacePair<2>& pair, const ModelBody<2>& body) {
  const ModelBody<2>& slave = model.bodyOf(pair.place);
  return &slave == &body ? model.bodyOf(pair.against.front()) : slave;
}

PartnerPlaces partnerPlaces(const Simulation<2>& simulation, const ModelBody<2>& body) {
  return placesBeside(simulation, body, meanDisplacement(body, simulation.stepping.state().x));
}

PartnerPlaces partnerPlacesOnNewMesh(const Simulation<2>& simulation, const ModelBody<2>& body) {
  return placesBeside(simulation, body, Eigen::Vector2d::Zero());
}

}  // namespace burnish::inline analysis
