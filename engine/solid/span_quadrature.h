#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/solid/body.h"

namespace burnish {

/// The quadrature of a body, with everything the total Lagrangian form freezes: basis values, reference
/// gradients and weights at all Gauss-Legendre points of all knot spans.
template <int Dim>
class SpanQuadrature {
 public:
  /// One knot span of one patch. Matrices are views with `n` functions and `Q` points.
  struct Span {
    int patch = 0;
    std::vector<int> nodes;   ///< n nodes
    int firstPoint = 0;       ///< number of its first quadrature point in the body
    Eigen::MatrixXd R;        ///< n x Q values R_a
    Eigen::MatrixXd G;        ///< n x Dim·Q reference gradients ∇_X R_a, columns Dim·q + d
    Eigen::VectorXd weights;  ///< Q: weight times det(∂X/∂ξ)
  };

  /// p+1 points per direction and span unless `pointsPerDirection` is positive.
  /// Throws `Error` if the map from parameters to space is folded (det <= 0) at a point.
  explicit SpanQuadrature(const Body<Dim>& body, int pointsPerDirection = 0);

  const std::vector<Span>& spans() const { return spans_; }
  int numPoints() const { return numPoints_; }
  int numNodes() const { return numNodes_; }

  /// Volume (area in 2D) of the body.
  double volume() const;

 private:
  std::vector<Span> spans_;
  int numPoints_ = 0;
  int numNodes_ = 0;
};

/// Parameter points and weights of the tensor-product rule with n points per direction on a span, first
/// direction fastest.
template <int P>
struct SpanRule {
  std::vector<Eigen::Vector<double, P>> points;
  std::vector<double> weights;  ///< in parameter space
};
template <int P>
SpanRule<P> spanRule(const TensorBasis<P>& basis, int span, int pointsPerDirection);

}  // namespace burnish
