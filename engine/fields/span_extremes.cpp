#include "engine/fields/span_extremes.h"

#include <algorithm>
#include <array>
#include <limits>

namespace burnish::inline fields {
namespace {

/// Applies one matrix per direction to the coefficients of a tensor product (first direction fastest).
template <int Dim>
Eigen::VectorXd applyTensor(const std::array<const Eigen::MatrixXd*, Dim>& matrices,
                            Eigen::VectorXd coefficients) {
  Eigen::Index stride = 1;
  for (const Eigen::MatrixXd* matrix : matrices) {
    const Eigen::Index n = matrix->cols(), m = matrix->rows(), blocks = coefficients.size() / (n * stride);
    Eigen::VectorXd result(blocks * m * stride);
    for (Eigen::Index b = 0; b < blocks; ++b) {
      const Eigen::Map<const Eigen::MatrixXd> from(coefficients.data() + b * n * stride, stride, n);
      Eigen::Map<Eigen::MatrixXd>(result.data() + b * m * stride, stride, m).noalias() =
          from * matrix->transpose();
    }
    coefficients = std::move(result);
    stride *= m;
  }
  return coefficients;
}

}  // namespace

template <int Dim>
SpanExtremes<Dim>::SpanExtremes(const Body<Dim>& body, int pointsPerDirection)
    : body_(body), points_(pointsPerDirection) {
  for (const auto& patch : body_.patches) {
    std::array<std::vector<Eigen::MatrixXd>, Dim> directions;
    for (int d = 0; d < Dim; ++d) {
      const auto& basis = patch.basis().direction(d);
      for (int e = 0; e < basis.numSpans(); ++e) {
        Eigen::MatrixXd values(points_, basis.degree() + 1);
        for (int k = 0; k < points_; ++k) {
          const double s = static_cast<double>(k) / (points_ - 1);
          const double xi = (1.0 - s) * basis.spanBegin(e) + s * basis.spanEnd(e);
          values.row(k) = basis.evaluate(e, xi, 0).col(0).transpose();
        }
        directions[static_cast<std::size_t>(d)].push_back(std::move(values));
      }
    }
    values_.push_back(std::move(directions));
  }
}

template <int Dim>
Extremes SpanExtremes<Dim>::operator()(const Eigen::VectorXd& coefficients) const {
  Extremes extremes{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::size_t p = 0; p < body_.patches.size(); ++p) {
    const auto& patch = body_.patches[p];
    for (int e = 0; e < patch.basis().numSpans(); ++e) {
      const auto index = patch.basis().spanIndex(e);
      std::array<const Eigen::MatrixXd*, Dim> matrices{};
      for (std::size_t d = 0; d < Dim; ++d) matrices[d] = &values_[p][d][static_cast<std::size_t>(index[d])];
      const auto functions = patch.basis().spanFunctions(e);
      Eigen::VectorXd weights = patch.weights()(functions), products(weights.size());
      for (std::size_t a = 0; a < functions.size(); ++a)
        products(static_cast<Eigen::Index>(a)) =
            weights(static_cast<Eigen::Index>(a)) *
            coefficients(body_.nodes[p][static_cast<std::size_t>(functions[a])]);
      const Eigen::VectorXd field =
          applyTensor<Dim>(matrices, products).cwiseQuotient(applyTensor<Dim>(matrices, weights));
      extremes.min = std::min(extremes.min, field.minCoeff());
      extremes.max = std::max(extremes.max, field.maxCoeff());
    }
  }
  return extremes;
}

template class SpanExtremes<2>;
template class SpanExtremes<3>;

}  // namespace burnish::inline fields
