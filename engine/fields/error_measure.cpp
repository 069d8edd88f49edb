#include "engine/fields/error_measure.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace burnish::inline fields {
namespace {

template <int Dim>
int highestDegree(const Body<Dim>& body) {
  int degree = 1;
  for (const auto& patch : body.patches)
    for (int d = 0; d < Dim; ++d) degree = std::max(degree, patch.basis().direction(d).degree());
  return degree;
}

double relative(double error, double norm) {
  return std::sqrt(norm > 0.0 ? error / norm : error);
}

}  // namespace

template <int Dim>
ErrorMeasure<Dim>::ErrorMeasure(const Body<Dim>& body, std::vector<Formula> exact)
    : quadrature_(body, highestDegree(body) + 3),
      nodes_(body.nodePositions()),
      exact_(std::move(exact)),
      step_(1e-3 * body.size()) {}

template <int Dim>
Eigen::Vector<double, Dim> ErrorMeasure<Dim>::exactDisplacement(const Eigen::Vector3d& X, double t) const {
  Eigen::Vector<double, Dim> u;
  for (int d = 0; d < Dim; ++d) u(d) = exact_[static_cast<std::size_t>(d)](X, t);
  return u;
}

template <int Dim>
Eigen::Matrix<double, Dim, Dim> ErrorMeasure<Dim>::exactGradient(const Eigen::Vector3d& X, double t) const {
  Eigen::Matrix<double, Dim, Dim> gradient;
  for (int d = 0; d < Dim; ++d) {
    const Eigen::Vector3d h = step_ * Eigen::Vector3d::Unit(d);
    gradient.col(d) = (8.0 * (exactDisplacement(X + h, t) - exactDisplacement(X - h, t)) -
                       (exactDisplacement(X + 2.0 * h, t) - exactDisplacement(X - 2.0 * h, t))) /
                      (12.0 * step_);
  }
  return gradient;
}

template <int Dim>
std::vector<double> ErrorMeasure<Dim>::values(const MeasuredState& state) const {
  double error = 0.0, norm = 0.0, gradientError = 0.0, gradientNorm = 0.0;
  const int columns = gradientColumns(quadrature_.kinematics());
  Eigen::MatrixXd ofValues, ofGradients;  // buffers
  for (const auto& span : quadrature_.spans()) {
    Eigen::MatrixXd u(Dim, static_cast<Eigen::Index>(span.nodes.size()));
    for (std::size_t a = 0; a < span.nodes.size(); ++a)
      u.col(static_cast<Eigen::Index>(a)) = state.x.template segment<Dim>(Dim * span.nodes[a]);
    const Eigen::MatrixXd &R = span.values(ofValues), &G = span.gradients(ofGradients);
    const Eigen::MatrixXd positions = nodes_(Eigen::all, span.nodes) * R;
    for (Eigen::Index q = 0; q < span.weights.size(); ++q) {
      Eigen::Vector3d X = Eigen::Vector3d::Zero();
      X.head<Dim>() = positions.col(q);
      const Eigen::Vector<double, Dim> exact = exactDisplacement(X, state.time);
      const Eigen::Matrix<double, Dim, Dim> exactSlope = exactGradient(X, state.time);
      error += span.weights(q) * (u * R.col(q) - exact).squaredNorm();
      norm += span.weights(q) * exact.squaredNorm();
      gradientError +=
          span.weights(q) * (u * G.template middleCols<Dim>(columns * q) - exactSlope).squaredNorm();
      gradientNorm += span.weights(q) * exactSlope.squaredNorm();
    }
  }
  return {relative(error, norm), relative(gradientError, gradientNorm)};
}

template class ErrorMeasure<2>;
template class ErrorMeasure<3>;

}  // namespace burnish::inline fields
