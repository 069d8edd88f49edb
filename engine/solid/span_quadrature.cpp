#include "engine/solid/span_quadrature.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/input_error.h"
#include "engine/nurbs/quadrature.h"

namespace burnish::inline solid {

template <int P>
ParameterBox<P> spanBox(const TensorBasis<P>& basis, int span) {
  const auto index = basis.spanIndex(span);
  ParameterBox<P> box;
  for (int d = 0; d < P; ++d) {
    const int e = index[static_cast<std::size_t>(d)];
    box.begin(d) = basis.direction(d).spanBegin(e);
    box.end(d) = basis.direction(d).spanEnd(e);
  }
  return box;
}

template <int P>
SpanRule<P> boxRule(const ParameterBox<P>& box, int pointsPerDirection) {
  const QuadratureRule rule = gaussLegendre(pointsPerDirection);
  int total = 1;
  for (int d = 0; d < P; ++d) total *= pointsPerDirection;
  SpanRule<P> result;
  for (int q = 0; q < total; ++q) {
    Eigen::Vector<double, P> xi;
    double weight = 1.0;
    for (int d = 0, rest = q; d < P; ++d, rest /= pointsPerDirection) {
      const int k = rest % pointsPerDirection;
      const double length = box.end(d) - box.begin(d);
      xi(d) = box.begin(d) + length * rule.points(k);
      weight *= length * rule.weights(k);
    }
    result.points.push_back(xi);
    result.weights.push_back(weight);
  }
  return result;
}

namespace {

/// Throws unless the patch is on the positive side of the axis and its map is not folded.
template <int Dim>
void requireSound(const Body<Dim>& body, std::size_t patch, const Eigen::Vector<double, Dim>& X, double det) {
  if (!(det > 0.0))
    throw InputError(
        "geometry",
        fmt::format("the map of patch {} is folded near ({:.4g}, {:.4g}): its determinant is {:.3g}; reorder "
                    "or move the control points so that it is positive everywhere",
                    patch + 1, X(0), X(1), det));
  if (body.axisymmetric && !(X(0) > 0.0))
    throw InputError("geometry",
                     fmt::format("patch {} crosses the axis of revolution near ({:.4g}, {:.4g}); x is the "
                                 "radius in axisymmetry, so move the control points to x >= 0",
                                 patch + 1, X(0), X(1)));
}

/// w_a D_m N_a of all functions at a point, m = 0 … 3: n x 4.
void weightedProducts(const TensorFactors& factors, Eigen::Index q,
                      Eigen::Matrix<double, Eigen::Dynamic, 4>& D) {
  std::array<const double*, 3> N{}, dN{};
  const Eigen::Index points = factors.N[0].cols() / 2;
  for (std::size_t d = 0; d < 3; ++d, q /= points) {
    N[d] = factors.N[d].col(q % points).data();
    dN[d] = factors.N[d].col(points + q % points).data();
  }
  D.resize(factors.weights.size(), 4);
  Eigen::Index a = 0;
  for (Eigen::Index a3 = 0; a3 < factors.N[2].rows(); ++a3)
    for (Eigen::Index a2 = 0; a2 < factors.N[1].rows(); ++a2) {
      const double none = N[1][a2] * N[2][a3], second = dN[1][a2] * N[2][a3], third = N[1][a2] * dN[2][a3];
      for (Eigen::Index a1 = 0; a1 < factors.N[0].rows(); ++a1, ++a) {
        const double w = factors.weights(a), own = w * N[0][a1];
        D(a, 0) = w * dN[0][a1] * none;
        D(a, 1) = own * second;
        D(a, 2) = own * third;
        D(a, 3) = own * none;
      }
    }
}

/// Functions and weights of a span, with room for the map.
TensorFactors tensorFactors(const Patch<3>& patch, int span, const SpanRule<3>& rule,
                            int pointsPerDirection) {
  const auto index = patch.basis().spanIndex(span);
  TensorFactors factors;
  std::size_t stride = 1;
  for (std::size_t d = 0; d < 3; ++d, stride *= static_cast<std::size_t>(pointsPerDirection)) {
    const auto& univariate = patch.basis().direction(static_cast<int>(d));
    auto& N = factors.N[d];
    N.resize(univariate.degree() + 1, 2 * pointsPerDirection);
    for (int q = 0; q < pointsPerDirection; ++q) {
      const double xi = rule.points[stride * static_cast<std::size_t>(q)](static_cast<Eigen::Index>(d));
      N(Eigen::all, {q, pointsPerDirection + q}) = univariate.evaluate(index[d], xi, 1);
    }
  }
  factors.weights = patch.weights()(patch.basis().spanFunctions(span));
  factors.map.resize(4, 3 * static_cast<Eigen::Index>(rule.points.size()));
  return factors;
}

}  // namespace

void TensorFactors::makeValues(Eigen::MatrixXd& R) const {
  const Eigen::Index Q = map.cols() / 3;
  R.resize(weights.size(), Q);
  Eigen::Matrix<double, Eigen::Dynamic, 4> D;
  for (Eigen::Index q = 0; q < Q; ++q) {
    weightedProducts(*this, q, D);
    R.col(q) = D.col(3) / D.col(3).sum();
  }
}

void TensorFactors::makeGradients(Eigen::MatrixXd& G) const {
  const Eigen::Index Q = map.cols() / 3;
  G.resize(weights.size(), 3 * Q);
  Eigen::Matrix<double, Eigen::Dynamic, 4> D;
  for (Eigen::Index q = 0; q < Q; ++q) {
    weightedProducts(*this, q, D);
    G.middleCols<3>(3 * q) = D.lazyProduct(map.middleCols<3>(3 * q));
  }
}

template <int Dim>
const Eigen::MatrixXd& SpanQuadrature<Dim>::Span::values(Eigen::MatrixXd& buffer) const {
  if constexpr (Dim == 2) return stored.R;
  factors.makeValues(buffer);
  return buffer;
}

template <int Dim>
const Eigen::MatrixXd& SpanQuadrature<Dim>::Span::gradients(Eigen::MatrixXd& buffer) const {
  if constexpr (Dim == 2) return stored.G;
  factors.makeGradients(buffer);
  return buffer;
}

template <int Dim>
SpanQuadrature<Dim>::SpanQuadrature(const Body<Dim>& body, int pointsPerDirection)
    : kinematics_(body.kinematics()), numNodes_(body.numNodes) {
  for (std::size_t p = 0; p < body.patches.size(); ++p) {
    const auto& basis = body.patches[p].basis();
    int degree = 1;
    for (int d = 0; d < Dim; ++d) degree = std::max(degree, basis.direction(d).degree());
    for (int e = 0; e < basis.numSpans(); ++e) {
      spans_.push_back(makeSpan(body, p, e, pointsPerDirection > 0 ? pointsPerDirection : degree + 1));
      numPoints_ += static_cast<int>(spans_.back().weights.size());
    }
  }
}

template <int Dim>
typename SpanQuadrature<Dim>::Span SpanQuadrature<Dim>::makeSpan(const Body<Dim>& body, std::size_t p,
                                                                 int number, int pointsPerDirection) const {
  const Patch<Dim>& patch = body.patches[p];
  const auto rule = spanRule(patch.basis(), number, pointsPerDirection);
  const auto functions = patch.basis().spanFunctions(number);
  const auto n = static_cast<Eigen::Index>(functions.size());
  const auto Q = static_cast<Eigen::Index>(rule.points.size());
  const int columns = gradientColumns(kinematics_);
  Span span{static_cast<int>(p), number, {}, numPoints_, Eigen::MatrixXd(Dim, Q),
            Eigen::VectorXd(Q),  0.0,    {}, {}};
  for (const int a : functions) span.nodes.push_back(body.nodes[p][static_cast<std::size_t>(a)]);
  const Eigen::MatrixXd points = patch.points()(Eigen::all, functions);
  if constexpr (Dim == 3)
    span.factors = tensorFactors(patch, number, rule, pointsPerDirection);
  else
    span.stored = {Eigen::MatrixXd(n, Q), Eigen::MatrixXd(n, columns * Q)};
  for (Eigen::Index q = 0; q < Q; ++q) {
    const auto& xi = rule.points[static_cast<std::size_t>(q)];
    const auto shape = patch.shape(number, xi);
    const Eigen::Matrix<double, Dim, Dim> jacobian = points * shape.dR;
    const Eigen::Vector<double, Dim> X = points * shape.R;
    const double det = jacobian.determinant();
    requireSound(body, p, X, det);
    span.xi.col(q) = xi;
    const Eigen::Matrix<double, Dim, Dim> inverse = jacobian.inverse();
    if constexpr (Dim == 2) {
      span.stored.R.col(q) = shape.R;
      span.stored.G.middleCols(columns * q, 2) = shape.dR * inverse;
      if (body.axisymmetric) span.stored.G.col(columns * q + 2) = shape.R / X(0);
    } else {
      // The univariate functions sum to one, so that 1/W = Σ R_a/w_a with W = Σ w_a N_a.
      const Eigen::RowVectorXd reciprocals = span.factors.weights.cwiseInverse().transpose();
      auto map = span.factors.map.template middleCols<3>(3 * q);
      map.template topRows<3>() = reciprocals.dot(shape.R) * inverse;
      map.row(3) = reciprocals * (shape.dR * inverse);
    }
    span.size += rule.weights[static_cast<std::size_t>(q)] * det;
    span.weights(q) = rule.weights[static_cast<std::size_t>(q)] * det * body.circumference(X);
  }
  span.size = std::pow(span.size, 1.0 / Dim);
  return span;
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
template ParameterBox<1> spanBox(const TensorBasis<1>&, int);
template ParameterBox<2> spanBox(const TensorBasis<2>&, int);
template ParameterBox<3> spanBox(const TensorBasis<3>&, int);
template SpanRule<1> boxRule(const ParameterBox<1>&, int);
template SpanRule<2> boxRule(const ParameterBox<2>&, int);
template SpanRule<3> boxRule(const ParameterBox<3>&, int);
template class SpanQuadrature<2>;
template class SpanQuadrature<3>;

}  // namespace burnish::inline solid
