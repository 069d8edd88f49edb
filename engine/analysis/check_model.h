#pragma once
#include <string>

#include "engine/analysis/model.h"
#include "engine/scene/scene.h"

namespace burnish::inline analysis {

/// Path of what a load of the scene is given by: `loads[0].pressure`.
std::string loadKey(const Scene& scene, std::size_t number);

/// Throws `InputError` at the keys of all formulas of supports, loads and tools that have no finite value at
/// a time point.
template <int Dim>
void requireFiniteFormulas(const Scene& scene, const Model<Dim>& model);

/// Throws `InputError` at `place` if the faces of a pair overlap at the start by more than rounding, unless
/// their interference is to be resolved.
template <int Dim>
void requireApart(const Model<Dim>& model, double overlap, const ContactSpec& spec, const std::string& place);

/// Throws `InputError` at `place` unless the tool of a pair can come into contact with its face: it begins in
/// front of the outer face, which is free to move. model: with its tools and supports.
template <int Dim>
void requireReachable(const Scene& scene, const Model<Dim>& model, const ContactSpec& spec,
                      const std::string& place);

/// Throws `InputError` if the supports leave a body free to move as a rigid whole, at the start or when some of
/// them have let go.
template <int Dim>
void requireSupported(const Scene& scene, const Model<Dim>& model);

/// Throws `InputError` if a face on the axis of revolution may leave it: no material holds it there, as its area is nothing.
template <int Dim>
void requireHeldAxis(const Model<Dim>& model);

}  // namespace burnish::inline analysis
