#pragma once
#include "engine/analysis/model.h"
#include "engine/scene/scene.h"

namespace burnish::inline analysis {

/// What a run takes, told before it is computed: counts of what it does, times what they cost on the machine of
/// docs/scale.md, whose cores are neither new nor old. Iterations that a run needs are not known beforehand; they
/// are taken as runs of the same kind have them.
struct CostEstimate {
  double bytes = 0.0;  ///< at most at once

  /// Seconds of one core per iteration of Newton's method.
  double assembly = 0.0, contact = 0.0, linearSystems = 0.0;
  double perIteration() const { return assembly + contact + linearSystems; }

  int steps = 0;
  double iterationsPerStep = 0.0;
  double fieldsAndFrames = 0.0;  ///< seconds of all steps and frames, without pictures
  double seconds() const { return steps * iterationsPerStep * perIteration() + fieldsAndFrames; }
};

/// Memory and time per iteration within a factor of 1.5 (bench/scale/cost_model.py has what it was fitted to).
/// Cut-backs, rezonings and pictures are not in it.
template <int Dim>
CostEstimate estimateCost(const Scene& scene, const Model<Dim>& model);

}  // namespace burnish::inline analysis
