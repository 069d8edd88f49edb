#pragma once
#include <Eigen/Dense>
#include <cstddef>
#include <vector>

#include "engine/solid/kinematics.h"
#include "engine/solid/span_quadrature.h"

namespace burnish::inline solid {

/// Calls f with the number of every quadrature point and its deformation gradient. firstPoint: gives the number of the first
/// point of a span; spans with a negative one are left out. x: unknowns, the displacements among them by node.
template <int Dim, class FirstPoint, class F>
void forEachGradient(const SpanQuadrature<Dim>& quadrature, const FirstPoint& firstPoint,
                     const Eigen::VectorXd& x, const F& f) {
  withKinematics<Dim>(quadrature.kinematics(), [&](auto kinematics) {
    constexpr Kinematics K = decltype(kinematics)::value;
    Eigen::Matrix<double, Eigen::Dynamic, Dim> u;
    Eigen::MatrixXd buffer;
    for (std::size_t e = 0; e < quadrature.spans().size(); ++e) {
      if (firstPoint(e) < 0) continue;
      const auto& span = quadrature.spans()[e];
      gatherNodes<Dim>(x, span.nodes, u);
      const Eigen::MatrixXd& G = span.gradients(buffer);
      for (Eigen::Index q = 0; q < span.weights.size(); ++q)
        f(static_cast<std::size_t>(firstPoint(e) + q),
          deformationGradient<K>(u, G.template middleCols<kColumns<K>>(kColumns<K> * q)));
    }
  });
}

/// The deformation gradients of all quadrature points.
template <int Dim>
std::vector<Eigen::Matrix3d> deformationGradients(const SpanQuadrature<Dim>& quadrature,
                                                  const Eigen::VectorXd& x) {
  std::vector<Eigen::Matrix3d> gradients(static_cast<std::size_t>(quadrature.numPoints()));
  forEachGradient(
      quadrature, [&](std::size_t span) { return quadrature.spans()[span].firstPoint; }, x,
      [&](std::size_t point, const Eigen::Matrix3d& F) { gradients[point] = F; });
  return gradients;
}

}  // namespace burnish::inline solid
