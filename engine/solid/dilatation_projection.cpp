#include "engine/solid/dilatation_projection.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unsupported/Eigen/KroneckerProduct>
#include <utility>

#include "engine/nurbs/derivative_space.h"
#include "engine/nurbs/function_values.h"
#include "engine/nurbs/quadrature.h"

namespace burnish {
namespace {

/// A span of a univariate basis of degree p, with n points.
struct UnivariateSpan {
  Eigen::MatrixXd B;          ///< p+1 x n: values of the basis
  Eigen::MatrixXd fit;        ///< p x n: coefficients of the least-squares fit by Π's functions
  Eigen::VectorXd integrals;  ///< p: of these functions
  Eigen::MatrixXd monomials;  ///< n x p: those below degree p, of a parameter from −1 to 1

  UnivariateSpan(const UnivariateBasis& basis, const UnivariateBasis& space, int span,
                 const QuadratureRule& rule)
      : B(basis.degree() + 1, rule.points.size()), monomials(rule.points.size(), basis.degree()) {
    const double begin = basis.spanBegin(span), length = basis.spanEnd(span) - begin;
    Eigen::MatrixXd N(basis.degree(), rule.points.size());
    for (Eigen::Index q = 0; q < rule.points.size(); ++q) {
      const double xi = begin + length * rule.points(q);
      B.col(q) = basis.evaluate(span, xi, 0);
      N.col(q) = space.evaluate(span, xi, 0);
    }
    for (Eigen::Index k = 0; k < monomials.cols(); ++k)
      monomials.col(k) = (2.0 * rule.points.array() - 1.0).pow(static_cast<double>(k));
    const Eigen::MatrixXd weighted = N * rule.weights.asDiagonal();
    fit = (weighted * N.transpose()).ldlt().solve(weighted);
    integrals = length * N * rule.weights;
  }
};

/// `DilatationProjection::sharesByItself` on the spans of a univariate basis with the points of a rule on each.
std::vector<Eigen::MatrixXd> univariateSharesByItself(const UnivariateBasis& basis,
                                                      const QuadratureRule& rule) {
  const UnivariateBasis space = basis.derivativeSpace();
  const int p = basis.degree();
  std::vector<UnivariateSpan> spans;
  Eigen::VectorXd integrals = Eigen::VectorXd::Zero(space.numFunctions());
  for (int e = 0; e < basis.numSpans(); ++e)
    integrals.segment(space.firstFunction(e), p) += spans.emplace_back(basis, space, e, rule).integrals;

  Eigen::MatrixXd averages = Eigen::MatrixXd::Zero(space.numFunctions(), basis.numFunctions());
  const auto averagesOn = [&](int e) {
    return averages.block(space.firstFunction(e), basis.firstFunction(e), p, p + 1);
  };
  for (int e = 0; e < basis.numSpans(); ++e) {
    const UnivariateSpan& span = spans[static_cast<std::size_t>(e)];
    const Eigen::VectorXd averaged =
        span.integrals.cwiseQuotient(integrals.segment(space.firstFunction(e), p));
    averagesOn(e) += averaged.asDiagonal() * span.fit * span.B.transpose();
  }

  std::vector<Eigen::MatrixXd> shares;
  for (int e = 0; e < basis.numSpans(); ++e) {
    const UnivariateSpan& span = spans[static_cast<std::size_t>(e)];
    const Eigen::MatrixXd coefficients = (span.B * span.B.transpose()).ldlt().solve(span.B);
    const Eigen::MatrixXd kept = averagesOn(e), polynomials = coefficients * span.monomials;
    const Eigen::MatrixXd missing = span.fit * span.monomials - kept * polynomials;
    const Eigen::MatrixXd least =
        polynomials * (polynomials.transpose() * polynomials).ldlt().solve(missing.transpose());
    shares.emplace_back((kept + least.transpose()) * coefficients);
  }
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
    span.L = span.averaged.asDiagonal() * (weighted * span.N.transpose()).ldlt().solve(weighted);
  }
  const double numPoints = static_cast<double>(quadrature.spans().front().weights.size());
  const QuadratureRule rule = gaussLegendre(static_cast<int>(std::lround(std::pow(numPoints, 1.0 / Dim))));
  for (const auto& patch : body.patches) {
    auto& shares = univariateShares_.emplace_back();
    for (int d = 0; d < Dim; ++d)
      shares[static_cast<std::size_t>(d)] = univariateSharesByItself(patch.basis().direction(d), rule);
  }
  workedOn_.resize(spans_.size());
  std::iota(workedOn_.begin(), workedOn_.end(), 0);
  own_ = workedOn_;
}

template <int Dim>
Eigen::MatrixXd DilatationProjection<Dim>::sharesByItself(std::size_t e) const {
  constexpr double kRounding = 1e-12;
  const Span& span = spans_[e];
  if ((span.averaged.array() > 1.0 - kRounding).all()) return span.L;
  const auto& ofPatch = univariateShares_[static_cast<std::size_t>(span.patch)];
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
Eigen::VectorXd DilatationProjection<Dim>::project(const SpanQuadrature<Dim>& quadrature,
                                                   const Eigen::VectorXd& values) const {
  const auto points = [&](std::size_t e) {
    const auto& span = quadrature.spans()[e];
    return Eigen::seqN(span.firstPoint, span.weights.size());
  };
  const Eigen::VectorXd coefficients =
      sumOverSpans([&](std::size_t e) -> Eigen::VectorXd { return spans_[e].L * values(points(e)); });
  Eigen::VectorXd result(values.size());
  for (std::size_t e = 0; e < spans_.size(); ++e)
    result(points(e)) = spans_[e].N.transpose() * coefficients(spans_[e].functions);
  return result;
}

template class DilatationProjection<2>;
template class DilatationProjection<3>;

}  // namespace burnish
