#pragma once
#include <string>

#include "engine/analysis/simulation.h"

namespace burnish {

/// What is known about a step that failed.
struct Failure {
  std::string findings;  ///< when and how, where the residual is largest, what contact and tools did
  std::string advice;    ///< what usually helps
};

/// Looks at the last iterate of a step that failed, at which the terms have just been evaluated.
template <int Dim>
Failure diagnose(const Simulation<Dim>& simulation);

}  // namespace burnish
