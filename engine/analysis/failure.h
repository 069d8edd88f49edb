#pragma once
#include <string>

#include "engine/analysis/model.h"
#include "engine/solver/newton.h"

namespace burnish {

/// What is known about a failed attempt at a step.
struct Failure {
  std::string findings;  ///< where the residual is largest, what the contact set did, the smallest J
  std::string advice;    ///< what usually helps
};

/// Looks at the last iterate, which the terms of the model have just been evaluated at.
template <int Dim>
Failure diagnose(const Model<Dim>& model, const NewtonReport& report);

}  // namespace burnish
