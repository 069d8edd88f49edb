#include "engine/rezoning/state_transfer.h"

#include <fmt/format.h>

#include <Eigen/Sparse>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/core/error.h"
#include "engine/material/symmetric_tensor.h"
#include "engine/nurbs/derivative_space.h"
#include "engine/nurbs/function_values.h"
#include "engine/rezoning/grid_interpolation.h"

namespace burnish::inline rezoning {
namespace {

/// f of the eigenvalues of a symmetric tensor.
template <class F>
Eigen::Matrix3d tensorFunction(const Eigen::Matrix3d& T, const F& f) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(T);
  return axes.eigenvectors() * axes.eigenvalues().unaryExpr(f).asDiagonal() * axes.eigenvectors().transpose();
}

/// The number that says how far matter has flowed, of laws that do (their `carried`).
constexpr const char* kPlasticStrain = "e_p";

/// Coordinates of the quadrature points of a patch in one direction.
template <int Dim>
std::vector<double> gridCoordinates(const SpanQuadrature<Dim>& quadrature, Eigen::Index direction) {
  std::vector<double> coordinates;
  for (const auto& span : quadrature.spans())
    coordinates.insert(coordinates.end(), span.xi.row(direction).begin(), span.xi.row(direction).end());
  std::sort(coordinates.begin(), coordinates.end());
  coordinates.erase(std::unique(coordinates.begin(), coordinates.end()), coordinates.end());
  return coordinates;
}

/// The solution of a system with the mass matrix of splines. In space its factors would fill, and conjugate
/// gradients find it in a few steps.
template <int Dim>
Eigen::VectorXd solvedMass(const Eigen::SparseMatrix<double>& mass, const Eigen::VectorXd& rhs) {
  if constexpr (Dim == 2) return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(mass).solve(rhs);
  constexpr double kTolerance = 1e-14;
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(kTolerance);
  return solver.compute(mass).solve(rhs);
}

/// A field projected onto the splines that span the derivatives of a basis.
template <int Dim>
class ReducedField {
 public:
  /// values: at the quadrature points of a body of one patch on the basis.
  ReducedField(const SpanQuadrature<Dim>& quadrature, const TensorBasis<Dim>& basis,
               const Eigen::VectorXd& values)
      : basis_(derivativeSpace(basis)) {
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(basis_.numFunctions());
    for (const auto& span : quadrature.spans()) {
      const auto functions = basis_.spanFunctions(span.number);
      const auto n = static_cast<Eigen::Index>(functions.size());
      Eigen::MatrixXd N(n, span.xi.cols());
      for (Eigen::Index q = 0; q < N.cols(); ++q)
        N.col(q) = functionValues<Dim>(basis_, span.number, span.xi.col(q));
      const Eigen::MatrixXd mass = N * span.weights.asDiagonal() * N.transpose();
      rhs(functions) += N * span.weights.cwiseProduct(values.segment(span.firstPoint, span.weights.size()));
      for (Eigen::Index b = 0; b < n; ++b)
        for (Eigen::Index a = 0; a < n; ++a)
          entries.emplace_back(functions[static_cast<std::size_t>(a)], functions[static_cast<std::size_t>(b)],
                               mass(a, b));
    }
    Eigen::SparseMatrix<double> mass(basis_.numFunctions(), basis_.numFunctions());
    mass.setFromTriplets(entries.begin(), entries.end());
    coefficients_ = solvedMass<Dim>(mass, rhs);
  }

  double operator()(const Eigen::Vector<double, Dim>& xi) const {
    typename TensorBasis<Dim>::Index index;
    for (int d = 0; d < Dim; ++d) index[static_cast<std::size_t>(d)] = basis_.direction(d).findSpan(xi(d));
    const int span = basis_.spanNumber(index);
    return functionValues(basis_, span, xi).dot(coefficients_(basis_.spanFunctions(span)));
  }

 private:
  TensorBasis<Dim> basis_;
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

template <int Dim>
PointStates interpolated(const SpanQuadrature<Dim>& quadrature, const TensorBasis<Dim>& basis,
                         const PointStates& states, const Eigen::MatrixXd& parameters) {
  constexpr Eigen::Index kComponents = kVoigt<Dim>;
  std::array<std::vector<double>, Dim> grid;
  for (std::size_t d = 0; d < Dim; ++d) grid[d] = gridCoordinates(quadrature, static_cast<Eigen::Index>(d));
  // One row at least beside those of the strain: how many there are decides how their sums are rounded.
  const Eigen::Index numRows = kComponents + std::max<Eigen::Index>(1, states.numbers.rows());
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(numRows, quadrature.numPoints());
  Eigen::VectorXd volumes(quadrature.numPoints());
  for (const auto& span : quadrature.spans())
    for (Eigen::Index q = 0; q < span.xi.cols(); ++q) {
      Eigen::Index place = 0;
      for (std::size_t d = Dim; d-- > 0;) {
        const auto found =
            std::lower_bound(grid[d].begin(), grid[d].end(), span.xi(static_cast<Eigen::Index>(d), q));
        place = place * std::ssize(grid[d]) + (found - grid[d].begin());
      }
      const auto point = static_cast<std::size_t>(span.firstPoint + q);
      Eigen::Matrix3d strain = tensorFunction(states.b_e[point], [](double v) { return std::log(v); });
      volumes(span.firstPoint + q) = strain.trace();
      strain.diagonal().array() -= strain.trace() / 3.0;
      values.col(place).template head<kComponents>() = components<Dim>(strain);
      values.col(place).segment(kComponents, states.numbers.rows()) = states.numbers.col(span.firstPoint + q);
    }
  const GridInterpolation<Dim> interpolation(std::move(grid), std::move(values));
  const ReducedField<Dim> volume(quadrature, basis, volumes);

  PointStates result{{}, states.kinds, Eigen::MatrixXd(states.numbers.rows(), parameters.cols())};
  for (Eigen::Index k = 0; k < parameters.cols(); ++k) {
    const Eigen::VectorXd value = interpolation(parameters.col(k));
    Eigen::Matrix3d strain = fullTensor<Dim>(value.template head<kComponents>());
    strain.diagonal().array() += (volume(parameters.col(k)) - strain.trace()) / 3.0;
    result.b_e.push_back(tensorFunction(strain, [](double v) { return std::exp(v); }));
    for (Eigen::Index n = 0; n < result.numbers.rows(); ++n)
      result.numbers(n, k) =
          std::max(result.kinds[static_cast<std::size_t>(n)].atLeast, value(kComponents + n));
  }
  return result;
}

PointStates regraded(const SpanQuadrature<3>& quadrature, const TensorBasis<3>& basis,
                     const PointStates& states, const SpanQuadrature<3>& next,
                     const std::vector<Eigen::Matrix3d>& gradients) {
  Eigen::MatrixXd parameters(3, next.numPoints());
  for (const auto& span : next.spans()) parameters.middleCols(span.firstPoint, span.xi.cols()) = span.xi;
  PointStates result = interpolated(quadrature, basis, states, parameters);
  const auto flow = std::ranges::find(states.kinds, kPlasticStrain, &CarriedKind::name);
  const bool flows = flow != states.kinds.end();
  const Eigen::Index row = flow - states.kinds.begin();
  for (Eigen::Index k = 0; k < parameters.cols(); ++k) {
    const Eigen::Matrix3d& F = gradients[static_cast<std::size_t>(k)];
    if (!flows || result.numbers(row, k) == 0.0) result.b_e[static_cast<std::size_t>(k)] = F * F.transpose();
  }
  return result;
}

template <int Dim>
ReferenceState referenceState(const SpanQuadrature<Dim>& quadrature, const PointStates& states,
                              std::vector<Eigen::Matrix3d> gradients) {
  ReferenceState reference{
      {}, states.numbers, Eigen::VectorXd(quadrature.numPoints()), 0.0, std::move(gradients)};
  for (const auto& b_e : states.b_e)
    reference.stretch.push_back(tensorFunction(b_e, [](double v) { return std::sqrt(v); }));
  for (const auto& span : quadrature.spans())
    for (Eigen::Index q = 0; q < span.weights.size(); ++q) {
      const auto point = span.firstPoint + q;
      const auto k = static_cast<std::size_t>(point);
      const double current = reference.gradients.empty()
                                 ? span.weights(q)
                                 : span.weights(q) * reference.gradients[k].determinant();
      reference.weights(point) = current / reference.stretch[k].determinant();
    }
  return reference;
}

template PointStates interpolated(const SpanQuadrature<2>&, const TensorBasis<2>&, const PointStates&,
                                  const Eigen::MatrixXd&);
template PointStates interpolated(const SpanQuadrature<3>&, const TensorBasis<3>&, const PointStates&,
                                  const Eigen::MatrixXd&);
template ReferenceState referenceState(const SpanQuadrature<2>&, const PointStates&,
                                       std::vector<Eigen::Matrix3d>);
template ReferenceState referenceState(const SpanQuadrature<3>&, const PointStates&,
                                       std::vector<Eigen::Matrix3d>);

}  // namespace burnish::inline rezoning
