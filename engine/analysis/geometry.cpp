#include "engine/analysis/geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "engine/core/input_error.h"
#include "engine/core/schedule.h"
#include "engine/nurbs/refinement.h"
#include "engine/scene/mesh_knots.h"
#include "engine/solid/joined_body.h"
#include "engine/solid/relief.h"

namespace burnish::inline analysis {
namespace {

/// Shapes of the other dimension do not reach this point: the dimension follows from the shape.
template <int Dim, class Shape>
Patch<Dim> coarse(const Shape& shape) {
  if constexpr (BringsKnots<Shape>)
    return shape.template patch<Dim>();
  else if constexpr (requires { requires Shape::kind.degrees.size() == Dim; })
    return shape.patch();
  else
    throw Error("geometry: the shape does not fit the number of dimensions");
}

using Definitions = std::vector<DefinitionSpec>;

/// Height of a relief at a place of the face. Throws `Error` beyond the ends of a measured profile.
std::function<double(const Eigen::Vector3d&)> reliefHeight(const ReliefSpec& relief,
                                                           const Definitions& definitions) {
  if (relief.height)
    return
        [height = Formula(*relief.height, definitions)](const Eigen::Vector3d& X) { return height(X, 0.0); };
  return [along = Formula(relief.along, definitions),
          profile = Schedule{relief.places, relief.heights}](const Eigen::Vector3d& X) {
    constexpr double kRounding = 1e-9;
    const double first = profile.times.front(), last = profile.times.back(), place = along(X, 0.0);
    const double beyond = kRounding * (last - first);
    if (place < first - beyond || place > last + beyond)
      throw Error(fmt::format(
          "the face needs the profile at {:.6g} (along, at X = ({:.6g}, {:.6g}, {:.6g})); found one from {:.6g} to {:.6g}",
          place, X(0), X(1), X(2), first, last));
    return profile(place);
  };
}

template <int Dim>
Patch<Dim> inRelief(Patch<Dim> patch, const Definitions& definitions,
                    const std::vector<ReliefSpec>& reliefs) {
  for (std::size_t k = 0; k < reliefs.size(); ++k) {
    const ReliefSpec& relief = reliefs[k];
    const auto height = reliefHeight(relief, definitions);
    const auto heightAt = [&](const Eigen::Vector<double, Dim>& place) {
      Eigen::Vector3d X = Eigen::Vector3d::Zero();
      X.head<Dim>() = place;
      return height(X);
    };
    try {
      patch = withRelief<Dim>(patch, faceFromName<Dim>(relief.face), heightAt);
    } catch (const Error& problem) {
      throw Error(fmt::format("relief[{}]: {}", k, problem.what()));
    }
  }
  return patch;
}

/// A shape on the body's basis.
template <int Dim, class Spec>
Patch<Dim> meshed(const BodySpec& body, const Definitions& definitions, const Spec& spec,
                  const MeshSpec& mesh) {
  Patch<Dim> shape = coarse<Dim>(spec);
  std::vector<KnotVector> target;
  bool asGiven = true;
  for (int d = 0; d < Dim; ++d) {
    const auto& direction = shape.basis().direction(d);
    const KnotVector knots(direction.degree(), direction.knots());
    target.push_back(meshKnots(body, definitions, mesh, static_cast<std::size_t>(d), knots));
    asGiven = asGiven && target.back() == knots;
  }
  if (body.basis == BasisChoice::Nurbs)
    return inRelief<Dim>(asGiven ? shape : refined(shape, target), definitions, mesh.relief);
  std::vector<std::vector<double>> breakpoints;
  for (const KnotVector& knots : target) breakpoints.push_back(knots.breakpoints());
  return inRelief<Dim>(lagrangeInterpolant(shape, body.degree, breakpoints), definitions, mesh.relief);
}

template <int Dim>
NamedBody<Dim> joined(const BodySpec& spec, const Definitions& definitions,
                      const std::vector<PatchSpec>& specs) {
  std::vector<Patch<Dim>> patches;
  std::vector<std::string> names;
  for (const PatchSpec& patch : specs) {
    patches.push_back(std::visit(
        [&](const auto& shape) { return meshed<Dim>(spec, definitions, shape, patch.mesh); }, patch.shape));
    names.push_back(patch.name);
  }
  try {
    auto body = joinedBody<Dim>(std::move(patches), names);
    return {std::move(body), std::move(names)};
  } catch (const Error& problem) {
    const auto hasRelief = [](const PatchSpec& patch) { return !patch.mesh.relief.empty(); };
    if (std::none_of(specs.begin(), specs.end(), hasRelief)) throw;
    throw Error(fmt::format("{}; a relief moves the face of its patch alone: where patches meet, give none",
                            problem.what()));
  }
}

template <int Dim>
struct BodyMaker {
  const BodySpec& body;
  const Definitions& definitions;

  NamedBody<Dim> operator()(const PatchesSpec& shape) const {
    return joined<Dim>(body, definitions, shape.patches);
  }

  template <class Shape>
  NamedBody<Dim> operator()(const Shape& shape) const {
    return {joinedBody<Dim>({meshed<Dim>(body, definitions, shape, body.geometry.mesh)}, {""}), {""}};
  }
};

}  // namespace

template <int Dim>
NamedBody<Dim> makeBody(const Scene& scene, std::size_t number) {
  try {
    const BodySpec& body = scene.allBodies()[number];
    NamedBody<Dim> made = std::visit(BodyMaker<Dim>{body, scene.definitions}, body.geometry.shape);
    made.body.axisymmetric = Dim == 2 && scene.kinematics == KinematicsChoice::Axisymmetric;
    return made;
  } catch (const Error& error) {
    throw InputError(scene.bodyKey(number, "geometry"), error.what());
  }
}

template NamedBody<2> makeBody(const Scene&, std::size_t);
template NamedBody<3> makeBody(const Scene&, std::size_t);

}  // namespace burnish::inline analysis
