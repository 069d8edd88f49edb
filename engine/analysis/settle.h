#pragma once
#include "engine/analysis/simulation.h"
#include "engine/solver/newton.h"

namespace burnish::inline analysis {

/// By this factor the augmentation parameter is larger while a simulation on a new mesh settles: with
/// multipliers that are only guessed, it is the gaps that tell rightly which control points are in contact.
inline constexpr double kSettlingStiffness = 200.0;

/// How a simulation came into equilibrium, or did not.
struct Settlement {
  NewtonReport report;
  double gapWork = 0.0;  ///< see `RezoningRecord`
};

/// Brings a simulation that begins on a new mesh of a body into equilibrium. The gaps with which the body's
/// contacts begin, and which they should not have where they are closed, are taken away in equal parts; in space, where
/// knots have changed and the place of the body is as it was, so are the forces that are out of balance.
template <int Dim>
Settlement settle(Simulation<Dim>& simulation, const ModelBody<Dim>& body, int parts);

}  // namespace burnish::inline analysis
