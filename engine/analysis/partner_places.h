#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/analysis/simulation.h"
#include "engine/core/state_archive.h"
#include "engine/tools/tool.h"

namespace burnish::inline analysis {

/// Where the tools and the bodies are that a body may touch.
struct PartnerPlaces {
  std::vector<ToolPose> tools;  ///< per tool

  /// Per pair of faces: of the other body against this one; zero for pairs of others.
  std::vector<Eigen::Vector2d> ways;

  /// Displacement of a tool since these places; of the other body of a pair.
  Eigen::Vector2d travelOfTool(std::size_t tool, const PartnerPlaces& now) const {
    return (now.tools[tool].displacement - tools[tool].displacement).head<2>();
  }
  Eigen::Vector2d travelOfPair(std::size_t pair, const PartnerPlaces& now) const {
    return now.ways[pair] - ways[pair];
  }

  void archive(StateArchive& archive);
};

/// The other body of a pair that a body has a face of.
const ModelBody<2>& otherBody(const Model<2>& model, const FacePair<2>& pair, const ModelBody<2>& body);

/// In the current state. The way of a body is the mean of its displacements, by reference volume.
PartnerPlaces partnerPlaces(const Simulation<2>& simulation, const ModelBody<2>& body);

/// The same once the displacements of the body count from this state on.
PartnerPlaces partnerPlacesOnNewMesh(const Simulation<2>& simulation, const ModelBody<2>& body);

}  // namespace burnish::inline analysis
