#pragma once
#include <optional>
#include <vector>

#include "engine/analysis/simulation.h"
#include "engine/scene/scene.h"
#include "engine/solid/reference_state.h"

namespace burnish::inline analysis {

/// Whether a body of the scene has been through something before the run.
bool hasInitialState(const Scene& scene);

/// What the scene says of a body before the run; none if it says nothing. Throws `InputError` at the key of a
/// stress that a point of the material cannot bear without flowing, or of a formula without a finite value.
template <int Dim>
std::optional<ReferenceState> initialState(const Scene& scene, std::size_t number, const Body<Dim>& body,
                                           const SpanQuadrature<Dim>& quadrature);

/// Brings the stress that bodies have before the run into equilibrium, with what holds and loads them at the start.
/// Returns the largest change of the stress, over the largest stress of the scene: max |σ - σ₀| / max |σ₀|, of the
/// tensors' norms at quadrature points; 0 without stress. Throws `RunError` if no equilibrium is found. To be
/// called by all ranks.
template <int Dim>
double settleInitialState(Simulation<Dim>& simulation);

}  // namespace burnish::inline analysis
