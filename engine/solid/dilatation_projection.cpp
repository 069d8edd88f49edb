#include "engine/solid/dilatation_projection.h"

#include <numeric>
#include <utility>

#include "engine/nurbs/derivative_space.h"
#include "engine/nurbs/function_values.h"

namespace burnish {
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
  workedOn_.resize(spans_.size());
  std::iota(workedOn_.begin(), workedOn_.end(), 0);
  own_ = workedOn_;
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
