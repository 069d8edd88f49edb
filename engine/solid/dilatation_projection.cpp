#include "engine/solid/dilatation_projection.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unsupported/Eigen/KroneckerProduct>
#include <utility>

#include "engine/nurbs/derivative_space.h"
#include "engine/nurbs/function_values.h"
#include "engine/nurbs/quadrature.h"

namespace burnish::inline solid {
namespace {

/// Where the volume per parameters changes by so much within a span, as beside a face that is collapsed to a point.
constexpr double kUneven = 30.0;

/// Of a span's tensor-product rule.
template <int Dim>
int pointsPerDirection(const typename SpanQuadrature<Dim>::Span& span) {
  return static_cast<int>(std::lround(std::pow(static_cast<double>(span.weights.size()), 1.0 / Dim)));
}

template <int Dim>
bool isUneven(const TensorBasis<Dim>& basis, const typename SpanQuadrature<Dim>::Span& span) {
  const auto inParameters = spanRule(basis, span.number, pointsPerDirection<Dim>(span)).weights;
  const Eigen::VectorXd stretch =
      span.weights.cwiseQuotient(Eigen::Map<const Eigen::VectorXd>(inParameters.data(), span.weights.size()));
  return stretch.maxCoeff() > kUneven * stretch.minCoeff();
}

/// A span of a univariate basis of degree p, with n points, n > p.
struct UnivariateSpan {
  int firstFunction, firstOfSpace;  ///< of the basis, and of Π's functions
  Eigen::MatrixXd B;                ///< p+1 x n: values of the basis
  Eigen::MatrixXd fit;              ///< p x n: coefficients of the least-squares fit by Π's functions
  Eigen::VectorXd integrals;        ///< p: of these functions
  Eigen::MatrixXd monomials;        ///< n x p: those below degree p, of a parameter from −1 to 1

  /// weights: of the points, n.
  UnivariateSpan(const UnivariateBasis& basis, const UnivariateBasis& space, int span,
                 const Eigen::VectorXd& points, const Eigen::VectorXd& weights)
      : firstFunction(basis.firstFunction(span)),
        firstOfSpace(space.firstFunction(span)),
        B(basis.degree() + 1, points.size()),
        monomials(points.size(), basis.degree()) {
    const double begin = basis.spanBegin(span), length = basis.spanEnd(span) - begin;
    Eigen::MatrixXd N(basis.degree(), points.size());
    for (Eigen::Index q = 0; q < points.size(); ++q) {
      const double xi = begin + length * points(q);
      B.col(q) = basis.evaluate(span, xi, 0);
      N.col(q) = space.evaluate(span, xi, 0);
    }
    for (Eigen::Index k = 0; k < monomials.cols(); ++k)
      monomials.col(k) = (2.0 * points.array() - 1.0).pow(static_cast<double>(k));
    const Eigen::MatrixXd weighted = N * weights.asDiagonal();
    fit = (weighted * N.transpose()).ldlt().solve(weighted);
    integrals = N * weights;
  }
};

/// `DilatationProjection::sharesByItself` on the spans of a univariate basis. weights: of the points on each span; points on (0, 1).
std::vector<Eigen::MatrixXd> univariateSharesByItself(const UnivariateBasis& basis,
                                                      const Eigen::VectorXd& points,
                                                      const std::vector<Eigen::VectorXd>& weights) {
  const UnivariateBasis space = basis.derivativeSpace();
  const int p = basis.degree();
  std::vector<UnivariateSpan> spans;
  Eigen::VectorXd integrals = Eigen::VectorXd::Zero(space.numFunctions());
  for (int e = 0; e < basis.numSpans(); ++e) {
    spans.emplace_back(basis, space, e, points, weights[static_cast<std::size_t>(e)]);
    integrals.segment(spans.back().firstOfSpace, p) += spans.back().integrals;
  }
  std::vector<Eigen::MatrixXd> contributions;  // of spans to the averages, p x p+1
  for (const UnivariateSpan& span : spans)
    contributions.emplace_back(
        span.integrals.cwiseQuotient(integrals.segment(span.firstOfSpace, p)).asDiagonal() * span.fit *
        span.B.transpose());

  std::vector<Eigen::MatrixXd> shares;
  for (std::size_t e = 0; e < spans.size(); ++e) {
    const UnivariateSpan& span = spans[e];
    Eigen::MatrixXd kept = Eigen::MatrixXd::Zero(p, p + 1);
    const auto reach = static_cast<std::size_t>(p);
    for (std::size_t other = e - std::min(e, reach); other < std::min(spans.size(), e + reach + 1); ++other) {
      const int down = spans[other].firstOfSpace - span.firstOfSpace;
      const int right = spans[other].firstFunction - span.firstFunction;
      for (int a = std::max(0, down); a < std::min(p, p + down); ++a)
        for (int b = std::max(0, right); b < std::min(p + 1, p + 1 + right); ++b)
          kept(a, b) += contributions[other](a - down, b - right);
    }
    const Eigen::MatrixXd coefficients = (span.B * span.B.transpose()).ldlt().solve(span.B);
    const Eigen::MatrixXd polynomials = coefficients * span.monomials;
    const Eigen::MatrixXd missing = span.fit * span.monomials - kept * polynomials;
    const Eigen::MatrixXd least =
        polynomials * (polynomials.transpose() * polynomials).ldlt().solve(missing.transpose());
    shares.emplace_back((kept + least.transpose()) * coefficients);
  }
  return shares;
}

/// Of a patch, by direction and span of that; empty where a direction has no more points on a span than its degree.
template <int Dim>
typename DilatationProjection<Dim>::DirectionShares sharesOfPatch(const TensorBasis<Dim>& basis, int patch,
                                                                  const SpanQuadrature<Dim>& quadrature) {
  typename DilatationProjection<Dim>::DirectionShares shares;
  int degree = 0, n = 0;
  std::array<std::vector<Eigen::VectorXd>, static_cast<std::size_t>(Dim)> weights;
  for (const auto& span : quadrature.spans()) {
    if (span.patch != patch) continue;
    const auto index = basis.spanIndex(span.number);
    n = pointsPerDirection<Dim>(span);
    for (std::size_t d = 0, stride = 1; d < weights.size(); ++d, stride *= static_cast<std::size_t>(n)) {
      if (weights[d].empty())
        weights[d].assign(static_cast<std::size_t>(basis.direction(static_cast<int>(d)).numSpans()),
                          Eigen::VectorXd::Zero(n));
      Eigen::VectorXd& sums = weights[d][static_cast<std::size_t>(index[d])];
      for (std::size_t q = 0; q < static_cast<std::size_t>(span.weights.size()); ++q)
        sums(static_cast<Eigen::Index>(q / stride) % n) += span.weights(static_cast<Eigen::Index>(q));
    }
  }
  for (int d = 0; d < Dim; ++d) degree = std::max(degree, basis.direction(d).degree());
  if (n <= degree) return shares;
  const QuadratureRule rule = gaussLegendre(n);
  for (std::size_t d = 0; d < shares.size(); ++d)
    shares[d] = univariateSharesByItself(basis.direction(static_cast<int>(d)), rule.points, weights[d]);
  return shares;
}

}  // namespace

template <int Dim>
DilatationProjection<Dim>::DilatationProjection(const Body<Dim>& body,
                                                const SpanQuadrature<Dim>& quadrature) {
  std::vector<TensorBasis<Dim>> spaces;
  std::vector<int> firstFunction;
  for (const auto& patch : body.patches) {
    firstFunction.push_back(numFunctions_);
    spaces.push_back(derivativeSpace(patch.basis()));
    numFunctions_ += spaces.back().numFunctions();
  }

  Eigen::VectorXd integrals = Eigen::VectorXd::Zero(numFunctions_);
  for (const auto& source : quadrature.spans()) {
    const auto patch = static_cast<std::size_t>(source.patch);
    const auto& space = spaces[patch];
    Span span;
    span.patch = source.patch;
    span.index = space.spanIndex(source.number);
    span.functions = space.spanFunctions(source.number);
    for (int& function : span.functions) function += firstFunction[patch];
    span.N.resize(space.functionsPerSpan(), source.weights.size());
    for (Eigen::Index q = 0; q < source.weights.size(); ++q)
      span.N.col(q) = functionValues<Dim>(space, source.number, source.xi.col(q));
    integrals(span.functions) += span.N * source.weights;
    spans_.push_back(std::move(span));
  }

  for (std::size_t e = 0; e < spans_.size(); ++e) {
    Span& span = spans_[e];
    const auto& weights = quadrature.spans()[e].weights;
    const Eigen::MatrixXd weighted = span.N * weights.asDiagonal();
    span.averaged = (span.N * weights).cwiseQuotient(integrals(span.functions));
    span.isUneven =
        isUneven(body.patches[static_cast<std::size_t>(span.patch)].basis(), quadrature.spans()[e]);
    span.L = span.averaged.asDiagonal() * (weighted * span.N.transpose()).ldlt().solve(weighted);
  }
  for (std::size_t patch = 0; patch < body.patches.size(); ++patch)
    directionShares_.push_back(
        sharesOfPatch(body.patches[patch].basis(), static_cast<int>(patch), quadrature));
  workedOn_.resize(spans_.size());
  std::iota(workedOn_.begin(), workedOn_.end(), 0);
  own_ = workedOn_;
}

template <int Dim>
Eigen::MatrixXd DilatationProjection<Dim>::sharesByItself(std::size_t e) const {
  constexpr double kRounding = 1e-12;
  const Span& span = spans_[e];
  const auto& ofPatch = directionShares_[static_cast<std::size_t>(span.patch)];
  const bool isAlone = (span.averaged.array() > 1.0 - kRounding).all();
  if (isAlone || span.isUneven || ofPatch.front().empty())
    return span.averaged.cwiseInverse().asDiagonal() * span.L;
  Eigen::MatrixXd shares = Eigen::MatrixXd::Ones(1, 1);
  for (std::size_t d = 0; d < ofPatch.size(); ++d)
    shares = Eigen::kroneckerProduct(ofPatch[d][static_cast<std::size_t>(span.index[d])], shares).eval();
  return shares;
}

template <int Dim>
void DilatationProjection<Dim>::divideAmong(const Team& team, std::vector<int> workedOn,
                                            std::vector<int> own) {
  team_ = &team;
  workedOn_ = std::move(workedOn);
  own_ = std::move(own);
  std::vector<Span> kept(spans_.size());
  for (const int e : workedOn_) {
    const auto span = static_cast<std::size_t>(e);
    kept[span] = std::move(spans_[span]);
  }
  spans_ = std::move(kept);
}

template <int Dim>
Eigen::VectorXd DilatationProjection<Dim>::project(std::span<const int> firstPoints,
                                                   const Eigen::VectorXd& values) const {
  const auto points = [&](std::size_t e) { return Eigen::seqN(firstPoints[e], spans_[e].N.cols()); };
  const Eigen::VectorXd coefficients =
      sumOverSpans([&](std::size_t e) -> Eigen::VectorXd { return spans_[e].L * values(points(e)); });
  Eigen::VectorXd result(values.size());
  for (const int number : workedOn_) {
    const auto e = static_cast<std::size_t>(number);
    result(points(e)) = spans_[e].N.transpose() * coefficients(spans_[e].functions);
  }
  return result;
}

template class DilatationProjection<2>;
template class DilatationProjection<3>;

}  // namespace burnish::inline solid
