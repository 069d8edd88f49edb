#include "engine/analysis/geometry.h"

#include <fmt/format.h>

#include <utility>

#include "engine/core/input_error.h"
#include "engine/nurbs/refinement.h"
#include "engine/scene/mesh_knots.h"
#include "engine/solid/joined_body.h"

namespace burnish {
namespace {

/// Shapes of the other dimension do not reach this point: the dimension follows from the shape.
template <int Dim, class Shape>
Patch<Dim> coarse(const Shape& shape) {
  if constexpr (Shape::kind.degrees.size() == Dim)
    return shape.patch();
  else
    throw Error("geometry: the shape does not fit the number of dimensions");
}
template <int Dim>
Patch<Dim> coarse(const ControlNetBody& net) {
  return net.patch<Dim>();
}

/// A shape on the scene's basis.
template <int Dim, class Spec>
Patch<Dim> meshed(const Scene& scene, const Spec& spec, const MeshSpec& mesh) {
  Patch<Dim> shape = coarse<Dim>(spec);
  std::vector<KnotVector> target;
  bool asGiven = true;
  for (int d = 0; d < Dim; ++d) {
    const auto& direction = shape.basis().direction(d);
    const KnotVector knots(direction.degree(), direction.knots());
    target.push_back(meshKnots(scene, mesh, static_cast<std::size_t>(d), knots));
    asGiven = asGiven && target.back() == knots;
  }
  if (scene.basis == BasisChoice::Nurbs) return asGiven ? shape : refined(shape, target);
  std::vector<std::vector<double>> breakpoints;
  for (const KnotVector& knots : target) breakpoints.push_back(knots.breakpoints());
  return lagrangeInterpolant(shape, scene.degree, breakpoints);
}

template <int Dim>
NamedBody<Dim> joined(const Scene& scene, const std::vector<PatchSpec>& specs) {
  std::vector<Patch<Dim>> patches;
  std::vector<std::string> names;
  for (const PatchSpec& patch : specs) {
    patches.push_back(
        std::visit([&](const auto& spec) { return meshed<Dim>(scene, spec, patch.mesh); }, patch.shape));
    names.push_back(patch.name);
  }
  auto body = joinedBody<Dim>(std::move(patches), names);
  return {std::move(body), std::move(names)};
}

template <int Dim>
struct BodyMaker {
  const Scene& scene;

  NamedBody<Dim> operator()(const PatchesSpec& spec) const { return joined<Dim>(scene, spec.patches); }

  template <class Spec>
  NamedBody<Dim> operator()(const Spec& spec) const {
    return {joinedBody<Dim>({meshed<Dim>(scene, spec, scene.geometry.mesh)}, {""}), {""}};
  }
};

}  // namespace

template <int Dim>
NamedBody<Dim> makeBody(const Scene& scene) {
  try {
    NamedBody<Dim> made = std::visit(BodyMaker<Dim>{scene}, scene.geometry.shape);
    made.body.axisymmetric = Dim == 2 && scene.kinematics == KinematicsChoice::Axisymmetric;
    return made;
  } catch (const Error& error) {
    throw InputError("geometry", error.what());
  }
}

template NamedBody<2> makeBody(const Scene&);
template NamedBody<3> makeBody(const Scene&);

}  // namespace burnish
