#pragma once
#include "engine/analysis/model.h"
#include "engine/core/team.h"
#include "engine/fields/projection.h"
#include "engine/results/result.h"

namespace burnish::inline analysis {

/// The meshes of all bodies.
template <int Dim>
MeshRecord meshRecord(const Model<Dim>& model);

/// The immutable part of a result.
template <int Dim>
ModelRecord makeModelRecord(const Scene& scene, const Model<Dim>& model);

/// The accepted state that the terms have just been evaluated at, as an output instant. projections: one per
/// body. To be called by all ranks of the team; those behind the first one are told the instant alone.
template <int Dim>
FrameRecord makeFrame(const Scene& scene, const Model<Dim>& model,
                      const std::vector<Projection<Dim>>& projections, int index, int step, double t,
                      const Eigen::VectorXd& x, const Team& team);

}  // namespace burnish::inline analysis
