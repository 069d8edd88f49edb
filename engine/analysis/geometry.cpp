#include "engine/analysis/geometry.h"

#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "engine/core/error.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"

namespace burnish {
namespace {

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

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
template <>
Patch<3> coarse<3>(const BoxSpec& spec) {
  return box(vector<3>(spec.origin), vector<3>(spec.size));
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

/// Number of knot spans (or elements) per direction that gives the wanted number of functions.
std::vector<int> spansOf(const Scene& scene) {
  if (!scene.geometry.spans.empty()) return scene.geometry.spans;
  std::vector<int> spans;
  for (const int functions : scene.geometry.functions)
    spans.push_back(scene.basis == BasisChoice::Nurbs ? functions - scene.degree
                                                      : (functions - 1) / scene.degree);
  return spans;
}

/// Knots of the wanted degree that divide the coarse shape's interval evenly.
template <int Dim>
Patch<Dim> onNurbs(const Patch<Dim>& shape, int degree, const std::vector<int>& spans) {
  std::vector<KnotVector> target;
  for (int d = 0; d < Dim; ++d) {
    const int exact = shape.basis().direction(d).degree();
    if (degree < exact)
      throw Error(
          fmt::format("degree: {} is too low for this shape, whose circular direction needs {} with NURBS; "
                      "raise degree or take basis: lagrange",
                      degree, exact));
    target.push_back(KnotVector::uniform(degree, spans[static_cast<std::size_t>(d)]));
  }
  return refined(shape, target);
}

template <int Dim>
Patch<Dim> onLagrange(const Patch<Dim>& shape, int degree, const std::vector<int>& spans) {
  std::vector<std::vector<double>> breakpoints;
  for (const int n : spans) breakpoints.push_back(KnotVector::uniform(1, n).breakpoints());
  return lagrangeInterpolant(shape, degree, breakpoints);
}

}  // namespace

template <int Dim>
Patch<Dim> makePatch(const Scene& scene) {
  if (const auto* net = std::get_if<ControlNetSpec>(&scene.geometry.shape)) return controlNet<Dim>(*net);
  const Patch<Dim> shape =
      std::visit([](const auto& spec) { return coarse<Dim>(spec); }, scene.geometry.shape);
  return scene.basis == BasisChoice::Nurbs ? onNurbs(shape, scene.degree, spansOf(scene))
                                           : onLagrange(shape, scene.degree, spansOf(scene));
}

template Patch<2> makePatch(const Scene&);
template Patch<3> makePatch(const Scene&);

}  // namespace burnish
