#pragma once
#include "engine/analysis/simulation.h"
#include "engine/solver/newton.h"

namespace burnish {

/// By this factor the augmentation parameter is larger while a simulation on a new mesh settles: with
/// multipliers that are only guessed, it is the gaps that tell rightly which control points are in contact.
inline constexpr double kSettlingStiffness = 200.0;

/// How a simulation came into equilibrium, or did not.
struct Settlement {
  NewtonReport report;
  double gapWork = 0.0;  ///< see `RezoningRecord`
};

/// Brings a simulation that begins on a new mesh into equilibrium. The gaps with which it begins, and which
/// pairs in contact should not have, are taken away in equal parts.
Settlement settle(Simulation<2>& simulation, int parts);

}  // namespace burnish
