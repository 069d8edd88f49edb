#pragma once
#include <string>

#include "engine/analysis/simulation.h"
#include "engine/scene/scene.h"

namespace burnish::inline analysis {

/// What is known about a step that failed.
struct Failure {
  std::string
      findings;  ///< when and how, where the residual is largest, what contact, tools and supports that let go did
  std::string advice;  ///< what usually helps
};

/// Looks at the last iterate of a step that failed, at which the terms have just been evaluated.
template <int Dim>
Failure diagnose(const Scene& scene, const Simulation<Dim>& simulation);

}  // namespace burnish::inline analysis
