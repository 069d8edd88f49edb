#include "engine/solid/span_quadrature.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/core/error.h"
#include "engine/nurbs/quadrature.h"

namespace burnish {

template <int P>
SpanRule<P> spanRule(const TensorBasis<P>& basis, int span, int pointsPerDirection) {
  const QuadratureRule rule = gaussLegendre(pointsPerDirection);
  const auto index = basis.spanIndex(span);
  int total = 1;
  for (int d = 0; d < P; ++d) total *= pointsPerDirection;
  SpanRule<P> result;
  for (int q = 0; q < total; ++q) {
    Eigen::Vector<double, P> xi;
    double weight = 1.0;
    for (int d = 0, rest = q; d < P; ++d, rest /= pointsPerDirection) {
      const int k = rest % pointsPerDirection;
      const int e = index[static_cast<std::size_t>(d)];
      const double begin = basis.direction(d).spanBegin(e), length = basis.direction(d).spanEnd(e) - begin;
      xi(d) = begin + length * rule.points(k);
      weight *= length * rule.weights(k);
    }
    result.points.push_back(xi);
    result.weights.push_back(weight);
  }
  return result;
}

template <int Dim>
SpanQuadrature<Dim>::SpanQuadrature(const Body<Dim>& body, int pointsPerDirection)
    : numNodes_(body.numNodes) {
  for (std::size_t p = 0; p < body.patches.size(); ++p) {
    const Patch<Dim>& patch = body.patches[p];
    const auto& basis = patch.basis();
    int degree = 1;
    for (int d = 0; d < Dim; ++d) degree = std::max(degree, basis.direction(d).degree());
    const int pointsOnSpan = pointsPerDirection > 0 ? pointsPerDirection : degree + 1;
    for (int e = 0; e < basis.numSpans(); ++e) {
      const auto rule = spanRule(basis, e, pointsOnSpan);
      const auto functions = basis.spanFunctions(e);
      const auto n = static_cast<Eigen::Index>(functions.size());
      const auto Q = static_cast<Eigen::Index>(rule.points.size());
      Span span{static_cast<int>(p), {}, numPoints_, Eigen::MatrixXd(n, Q), Eigen::MatrixXd(n, Dim * Q),
                Eigen::VectorXd(Q)};
      for (const int a : functions) span.nodes.push_back(body.nodes[p][static_cast<std::size_t>(a)]);
      const Eigen::MatrixXd points = patch.points()(Eigen::all, functions);
      for (Eigen::Index q = 0; q < Q; ++q) {
        const auto& xi = rule.points[static_cast<std::size_t>(q)];
        const auto shape = patch.shape(e, xi);
        const Eigen::Matrix<double, Dim, Dim> jacobian = points * shape.dR;
        const double det = jacobian.determinant();
        if (!(det > 0.0)) {
          const Eigen::Vector<double, Dim> X = points * shape.R;
          throw Error(
              fmt::format("geometry: the map of patch {} is folded near ({:.4g}, {:.4g}): its determinant is "
                          "{:.3g}; reorder or move the control points so that it is positive everywhere",
                          p + 1, X(0), X(1), det));
        }
        span.R.col(q) = shape.R;
        span.G.middleCols(Dim * q, Dim) = shape.dR * jacobian.inverse();
        span.weights(q) = rule.weights[static_cast<std::size_t>(q)] * det;
      }
      numPoints_ += static_cast<int>(Q);
      spans_.push_back(std::move(span));
    }
  }
}

template <int Dim>
double SpanQuadrature<Dim>::volume() const {
  double sum = 0.0;
  for (const auto& span : spans_) sum += span.weights.sum();
  return sum;
}

template struct SpanRule<1>;
template struct SpanRule<2>;
template struct SpanRule<3>;
template SpanRule<1> spanRule(const TensorBasis<1>&, int, int);
template SpanRule<2> spanRule(const TensorBasis<2>&, int, int);
template SpanRule<3> spanRule(const TensorBasis<3>&, int, int);
template class SpanQuadrature<2>;
template class SpanQuadrature<3>;

}  // namespace burnish
