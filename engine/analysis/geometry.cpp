#include "engine/analysis/geometry.h"

#include <fmt/format.h>

#include <utility>

#include "engine/core/angles.h"
#include "engine/core/input_error.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/scene/mesh_knots.h"
#include "engine/solid/joined_body.h"

namespace burnish {
namespace {

template <int Dim>
Eigen::Vector<double, Dim> vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::Vector<double, Dim>>(values.data());
}

/// Shapes of the other dimension do not reach this point: the dimension follows from the shape.
template <int Dim, class Spec>
Patch<Dim> coarse(const Spec&) {
  throw Error("geometry: the shape does not fit the number of dimensions");
}
template <>
Patch<2> coarse<2>(const RectangleSpec& spec) {
  return rectangle(vector<2>(spec.origin), vector<2>(spec.size));
}
template <>
Patch<2> coarse<2>(const AnnulusSpec& spec) {
  return annulus(vector<2>(spec.center), spec.innerRadius, spec.outerRadius, radians(spec.startAngle),
                 radians(spec.openingAngle));
}
/// A disc, whole or a sector; `Spec`: a `DiscSpec` or a `CylinderSpec`.
template <class Spec>
Patch<2> discOf(const Spec& spec, const Eigen::Vector2d& center) {
  const double start = radians(spec.startAngle);
  return spec.openingAngle == 360.0 ? disc(center, spec.radius, start)
                                    : discSector(center, spec.radius, start, radians(spec.openingAngle));
}
template <>
Patch<2> coarse<2>(const DiscSpec& spec) {
  return discOf(spec, vector<2>(spec.center));
}
template <>
Patch<2> coarse<2>(const EllipseSpec& spec) {
  return ellipse(vector<2>(spec.center), vector<2>(spec.size));
}
template <>
Patch<3> coarse<3>(const BoxSpec& spec) {
  return box(vector<3>(spec.origin), vector<3>(spec.size));
}
template <>
Patch<3> coarse<3>(const TubeSpec& spec) {
  const Patch<2> ring = annulus({0.0, 0.0}, spec.innerRadius, spec.outerRadius, radians(spec.startAngle),
                                radians(spec.openingAngle));
  return swept(ring, vector<3>(spec.center), vector<3>(spec.axis), spec.length);
}
template <>
Patch<3> coarse<3>(const CylinderSpec& spec) {
  return swept(discOf(spec, {0.0, 0.0}), vector<3>(spec.center), vector<3>(spec.axis), spec.length);
}
template <>
Patch<3> coarse<3>(const BallOctantSpec& spec) {
  return ballOctant(vector<3>(spec.center), spec.radius, vector<3>(spec.pole));
}

template <int Dim>
Patch<Dim> controlNet(const ControlNetSpec& spec) {
  std::vector<UnivariateBasis> directions;
  for (std::size_t d = 0; d < spec.knots.size(); ++d)
    directions.push_back(UnivariateBasis::bspline(KnotVector(spec.degrees[d], spec.knots[d])));
  TensorBasis<Dim> basis(std::move(directions));
  Eigen::MatrixXd points(Dim, static_cast<Eigen::Index>(spec.points.size()));
  for (std::size_t a = 0; a < spec.points.size(); ++a)
    points.col(static_cast<Eigen::Index>(a)) = vector<Dim>(spec.points[a]);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(points.cols());
  for (std::size_t a = 0; a < spec.weights.size(); ++a)
    weights(static_cast<Eigen::Index>(a)) = spec.weights[a];
  return {std::move(basis), std::move(points), std::move(weights)};
}
template <>
Patch<2> coarse<2>(const ControlNetSpec& spec) {
  return controlNet<2>(spec);
}
template <>
Patch<3> coarse<3>(const ControlNetSpec& spec) {
  return controlNet<3>(spec);
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
