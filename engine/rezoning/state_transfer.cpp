#include "engine/rezoning/state_transfer.h"

#include <fmt/format.h>

#include <Eigen/Sparse>
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/error.h"
#include "engine/material/symmetric_tensor.h"
#include "engine/rezoning/grid_interpolation.h"

namespace burnish {
namespace {

/// f of the eigenvalues of a symmetric tensor.
template <class F>
Eigen::Matrix3d tensorFunction(const Eigen::Matrix3d& T, const F& f) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(T);
  return axes.eigenvectors() * axes.eigenvalues().unaryExpr(f).asDiagonal() * axes.eigenvectors().transpose();
}

/// Coordinates of the quadrature points of a patch in one direction.
std::vector<double> gridCoordinates(const SpanQuadrature<2>& quadrature, Eigen::Index direction) {
  std::vector<double> coordinates;
  for (const auto& span : quadrature.spans())
    coordinates.insert(coordinates.end(), span.xi.row(direction).begin(), span.xi.row(direction).end());
  std::sort(coordinates.begin(), coordinates.end());
  coordinates.erase(std::unique(coordinates.begin(), coordinates.end()), coordinates.end());
  return coordinates;
}

/// A field projected onto the splines that span the derivatives of a basis.
class ReducedField {
 public:
  /// values: at the quadrature points of a body of one patch on the basis.
  ReducedField(const SpanQuadrature<2>& quadrature, const TensorBasis<2>& basis,
               const Eigen::VectorXd& values)
      : basis_({basis.direction(0).derivativeSpace(), basis.direction(1).derivativeSpace()}) {
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(basis_.numFunctions());
    for (const auto& span : quadrature.spans()) {
      const auto functions = basis_.spanFunctions(span.number);
      const auto n = static_cast<Eigen::Index>(functions.size());
      Eigen::MatrixXd N(n, span.xi.cols());
      for (Eigen::Index q = 0; q < N.cols(); ++q) N.col(q) = valuesAt(span.number, span.xi.col(q));
      const Eigen::MatrixXd mass = N * span.weights.asDiagonal() * N.transpose();
      rhs(functions) += N * span.weights.cwiseProduct(values.segment(span.firstPoint, span.weights.size()));
      for (Eigen::Index b = 0; b < n; ++b)
        for (Eigen::Index a = 0; a < n; ++a)
          entries.emplace_back(functions[static_cast<std::size_t>(a)], functions[static_cast<std::size_t>(b)],
                               mass(a, b));
    }
    Eigen::SparseMatrix<double> mass(basis_.numFunctions(), basis_.numFunctions());
    mass.setFromTriplets(entries.begin(), entries.end());
    coefficients_ = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(mass).solve(rhs);
  }

  double operator()(const Eigen::Vector2d& xi) const {
    const int span =
        basis_.spanNumber({basis_.direction(0).findSpan(xi(0)), basis_.direction(1).findSpan(xi(1))});
    return valuesAt(span, xi).dot(coefficients_(basis_.spanFunctions(span)));
  }

 private:
  Eigen::VectorXd valuesAt(int span, const Eigen::Vector2d& xi) const {
    const auto index = basis_.spanIndex(span);
    const Eigen::VectorXd first = basis_.direction(0).evaluate(index[0], xi(0), 0);
    const Eigen::VectorXd second = basis_.direction(1).evaluate(index[1], xi(1), 0);
    return (first * second.transpose()).reshaped();
  }

  TensorBasis<2> basis_;
  Eigen::VectorXd coefficients_;
};

}  // namespace

Eigen::Matrix2Xd parametersIn(const InverseMap<2>& old, const Eigen::Matrix2Xd& positions, double farthest) {
  Eigen::Matrix2Xd parameters(2, positions.cols());
  Eigen::Vector2d guess = Eigen::Vector2d::Zero();
  for (Eigen::Index k = 0; k < positions.cols(); ++k) {
    const auto found = old(positions.col(k), guess);
    if (found.distance > farthest)
      throw Error(fmt::format("a point of the new mesh lies {:.2g} outside the old one", found.distance));
    guess = found.xi;
    parameters.col(k) = guess;
  }
  return parameters;
}

Eigen::Matrix2Xd pointPositions(const SpanQuadrature<2>& quadrature, const Patch<2>& patch) {
  Eigen::Matrix2Xd positions(2, quadrature.numPoints());
  Eigen::MatrixXd buffer;
  for (const auto& span : quadrature.spans())
    positions.middleCols(span.firstPoint, span.weights.size()) =
        patch.points()(Eigen::all, span.nodes) * span.values(buffer);
  return positions;
}

PointStates interpolated(const SpanQuadrature<2>& quadrature, const TensorBasis<2>& basis,
                         const PointStates& states, const Eigen::Matrix2Xd& parameters) {
  std::array<std::vector<double>, 2> grid{gridCoordinates(quadrature, 0), gridCoordinates(quadrature, 1)};
  // One row at least beside those of the strain: how many there are decides how their sums are rounded.
  const Eigen::Index numRows = 4 + std::max<Eigen::Index>(1, states.numbers.rows());
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(numRows, quadrature.numPoints());
  Eigen::VectorXd volumes(quadrature.numPoints());
  for (const auto& span : quadrature.spans())
    for (Eigen::Index q = 0; q < span.xi.cols(); ++q) {
      Eigen::Index place = 0;
      for (std::size_t d = 2; d-- > 0;) {
        const auto found =
            std::lower_bound(grid[d].begin(), grid[d].end(), span.xi(static_cast<Eigen::Index>(d), q));
        place = place * std::ssize(grid[d]) + (found - grid[d].begin());
      }
      const auto point = static_cast<std::size_t>(span.firstPoint + q);
      Eigen::Matrix3d strain = tensorFunction(states.b_e[point], [](double v) { return std::log(v); });
      volumes(span.firstPoint + q) = strain.trace();
      strain.diagonal().array() -= strain.trace() / 3.0;
      values.col(place).head<4>() = components<2>(strain);
      values.col(place).segment(4, states.numbers.rows()) = states.numbers.col(span.firstPoint + q);
    }
  const GridInterpolation interpolation(std::move(grid), std::move(values));
  const ReducedField volume(quadrature, basis, volumes);

  PointStates result{{}, states.kinds, Eigen::MatrixXd(states.numbers.rows(), parameters.cols())};
  for (Eigen::Index k = 0; k < parameters.cols(); ++k) {
    const Eigen::VectorXd value = interpolation(parameters.col(k));
    Eigen::Matrix3d strain = fullTensor<2>(value.head<4>());
    strain.diagonal().array() += (volume(parameters.col(k)) - strain.trace()) / 3.0;
    result.b_e.push_back(tensorFunction(strain, [](double v) { return std::exp(v); }));
    for (Eigen::Index n = 0; n < result.numbers.rows(); ++n)
      result.numbers(n, k) = std::max(result.kinds[static_cast<std::size_t>(n)].atLeast, value(4 + n));
  }
  return result;
}

template <int Dim>
ReferenceState referenceState(const SpanQuadrature<Dim>& quadrature, const PointStates& states) {
  ReferenceState reference{{}, states.numbers, Eigen::VectorXd(quadrature.numPoints()), 0.0};
  for (const auto& b_e : states.b_e)
    reference.stretch.push_back(tensorFunction(b_e, [](double v) { return std::sqrt(v); }));
  for (const auto& span : quadrature.spans())
    for (Eigen::Index q = 0; q < span.weights.size(); ++q) {
      const auto point = span.firstPoint + q;
      reference.weights(point) =
          span.weights(q) / reference.stretch[static_cast<std::size_t>(point)].determinant();
    }
  return reference;
}

template ReferenceState referenceState(const SpanQuadrature<2>&, const PointStates&);
template ReferenceState referenceState(const SpanQuadrature<3>&, const PointStates&);

}  // namespace burnish
