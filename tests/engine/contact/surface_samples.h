#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <functional>
#include <random>
#include <vector>

#include "engine/contact/master_surface.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"

namespace burnish::test {

/// Faces of a patch, as `faceFromName` numbers them; `kInner`: of a ring, "left".
inline constexpr FaceId kInner = 0, kRight = 1, kBottom = 2, kTop = 3, kFront = 5;

template <int Dim>
struct Sample {
  SurfacePlace<Dim> place;
  Eigen::Vector<double, Dim> x;
};

/// Points of a surface, `count` in every direction of every span, away from its knots.
template <int Dim>
std::vector<Sample<Dim>> samples(const MasterSurface<Dim>& surface, int count) {
  std::vector<Sample<Dim>> result;
  const int perSpan = Dim == 2 ? count : count * count;
  for (int face = 0; face < surface.numFaces(); ++face)
    for (int span = 0; span < surface.basis(face).numSpans(); ++span)
      for (int k = 0; k < perSpan; ++k) {
        SurfacePlace<Dim> place{face, span, {}};
        const auto index = surface.basis(face).spanIndex(span);
        for (int d = 0, rest = k; d < Dim - 1; ++d, rest /= count) {
          const auto& direction = surface.basis(face).direction(d);
          const int number = index[static_cast<std::size_t>(d)];
          place.xi(d) =
              std::lerp(direction.spanBegin(number), direction.spanEnd(number), (rest % count + 0.5) / count);
        }
        result.push_back({place, surface.at(place).x});
      }
  return result;
}

template <int Dim>
const Sample<Dim>& nearest(const std::vector<Sample<Dim>>& samples, const Eigen::Vector<double, Dim>& x) {
  return *std::min_element(samples.begin(), samples.end(),
                           [&](const auto& a, const auto& b) { return (a.x - x).norm() < (b.x - x).norm(); });
}

/// A unit block of equal spans with weights between 0.8 and 1.2 and control points moved by up to `amplitude`
/// over the number of spans, both random.
template <int Dim>
Patch<Dim> wavy(BasisFamily family, int degree, int spans, double amplitude, unsigned seed) {
  Patch<Dim> block = [] {
    if constexpr (Dim == 2)
      return rectangle({0.0, 0.0}, {1.0, 1.0});
    else
      return box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  }();
  const KnotVector knots = KnotVector::uniform(degree, spans);
  block =
      family == BasisFamily::BSpline
          ? refined(block, std::vector<KnotVector>(Dim, knots))
          : lagrangeInterpolant(block, degree, std::vector<std::vector<double>>(Dim, knots.breakpoints()));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::MatrixXd points = block.points();
  Eigen::VectorXd weights = block.weights();
  for (double& coordinate : points.reshaped()) coordinate += amplitude / spans * uniform(random);
  for (double& weight : weights) weight += 0.2 * uniform(random);
  return {block.basis(), std::move(points), std::move(weights)};
}

/// Derivative of a vector of functions by some of the unknowns, of the others zero: fourth-order central
/// differences, columns per unknown.
inline Eigen::MatrixXd differences(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f,
                                   const Eigen::VectorXd& u, const std::vector<int>& unknowns, double h) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(f(u).size(), u.size());
  for (const int j : unknowns) {
    const auto at = [&](double steps) {
      Eigen::VectorXd shifted = u;
      shifted(j) += steps * h;
      return f(shifted);
    };
    result.col(j) = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h);
  }
  return result;
}

}  // namespace burnish::test
