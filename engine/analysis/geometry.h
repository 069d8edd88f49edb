#pragma once
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/solid/body.h"

namespace burnish::inline analysis {

/// A body and the names of its patches; a body of a single shape is one patch without a name.
template <int Dim>
struct NamedBody {
  Body<Dim> body;
  std::vector<std::string> names;
};

/// The reference geometry of a scene's body, by its number, on the basis, degree and meshes that it asks for,
/// matching faces joined.
/// Lagrange bases interpolate the exact shapes at their nodes. Throws `InputError` for what the reader cannot
/// see: patches that lie on each other and do not match, or that are not connected.
template <int Dim>
NamedBody<Dim> makeBody(const Scene& scene, std::size_t number = 0);

}  // namespace burnish::inline analysis
