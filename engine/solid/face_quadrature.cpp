#include "engine/solid/face_quadrature.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/solid/span_quadrature.h"

namespace burnish::inline solid {
namespace {

/// What a span and a part of the face have in common; empty boxes have an end at or before their beginning.
template <int P>
ParameterBox<P> clipped(ParameterBox<P> box, const TensorBasis<P>& basis, const std::vector<double>& part) {
  for (std::size_t d = 0; 2 * d + 1 < part.size(); ++d) {
    const auto i = static_cast<Eigen::Index>(d);
    const auto& direction = basis.direction(static_cast<int>(d));
    box.begin(i) = std::max(box.begin(i), direction.parameterAt(part[2 * d]));
    box.end(i) = std::min(box.end(i), direction.parameterAt(part[2 * d + 1]));
  }
  return box;
}

}  // namespace

template <int Dim>
FaceQuadrature<Dim>::FaceQuadrature(const Body<Dim>& body, int patch, FaceId face, int pointsPerDirection,
                                    const std::vector<double>& part)
    : trace_(tracePatch(body.patches[static_cast<std::size_t>(patch)], face)) {
  const auto& volume = body.patches[static_cast<std::size_t>(patch)];
  for (const int a : faceFunctions(volume.basis(), face))
    nodes_.push_back(body.nodes[static_cast<std::size_t>(patch)][static_cast<std::size_t>(a)]);

  int degree = 1;
  for (int d = 0; d < Dim - 1; ++d) degree = std::max(degree, trace_.basis().direction(d).degree());
  for (int e = 0; e < trace_.basis().numSpans(); ++e) {
    const auto box = clipped(spanBox(trace_.basis(), e), trace_.basis(), part);
    if (!((box.end - box.begin).minCoeff() > 0.0)) continue;
    Span span = this->part(body, e, box, pointsPerDirection > 0 ? pointsPerDirection : degree + 1);
    span.firstPoint = numPoints_;
    numPoints_ += static_cast<int>(span.weights.size());
    spans_.push_back(std::move(span));
  }
}

template <int Dim>
typename FaceQuadrature<Dim>::Span FaceQuadrature<Dim>::part(const Body<Dim>& body, int number,
                                                             const ParameterBox<Dim - 1>& box,
                                                             int pointsPerDirection) const {
  const auto rule = boxRule(box, pointsPerDirection);
  Span span{number, trace_.basis().spanFunctions(number), 0, {}, {}, {}, {}, {}, 0.0};
  const auto n = static_cast<Eigen::Index>(span.functions.size());
  const auto Q = static_cast<Eigen::Index>(rule.points.size());
  span.xi.resize(Dim - 1, Q);
  span.R.resize(n, Q);
  span.dR.resize(n, (Dim - 1) * Q);
  span.weights.resize(Q);
  span.ruleWeights = Eigen::Map<const Eigen::VectorXd>(rule.weights.data(), Q);
  const Eigen::MatrixXd points = trace_.points()(Eigen::all, span.functions);
  for (Eigen::Index q = 0; q < Q; ++q) {
    const auto shape = trace_.shape(number, rule.points[static_cast<std::size_t>(q)]);
    const Eigen::Matrix<double, Dim, Dim - 1> tangents = points * shape.dR;
    span.xi.col(q) = rule.points[static_cast<std::size_t>(q)];
    span.R.col(q) = shape.R;
    span.dR.middleCols((Dim - 1) * q, Dim - 1) = shape.dR;
    const Eigen::Vector<double, Dim> X = points * shape.R;
    const double area = rule.weights[static_cast<std::size_t>(q)] * areaVector<Dim>(tangents).norm();
    span.size += area;
    span.weights(q) = area * body.circumference(X);
  }
  if (Dim == 3) span.size = std::sqrt(span.size);
  return span;
}

template <int Dim>
Eigen::MatrixXd FaceQuadrature<Dim>::positions(const Span& span, const Eigen::VectorXd& x) const {
  Eigen::MatrixXd current = points()(Eigen::all, span.functions);
  for (std::size_t a = 0; a < span.functions.size(); ++a)
    current.col(static_cast<Eigen::Index>(a)) +=
        x.template segment<Dim>(Dim * nodes_[static_cast<std::size_t>(span.functions[a])]);
  return current * span.R;
}

template <int Dim>
Eigen::MatrixXd FaceQuadrature<Dim>::positions(const Eigen::VectorXd& x) const {
  Eigen::MatrixXd result(Dim, numPoints_);
  for (const Span& span : spans_) result.middleCols(span.firstPoint, span.R.cols()) = positions(span, x);
  return result;
}

template <int Dim>
double outwardSign(const Patch<Dim>& patch, FaceId face) {
  const int across = face / 2;
  Eigen::Vector<double, Dim> middle;
  for (int d = 0; d < Dim; ++d)
    middle(d) = patch.basis().direction(d).parameterAt(d == across ? face % 2 : 0.5);
  const Eigen::Matrix<double, Dim, Dim> jacobian = patch.jacobian(middle);
  Eigen::Matrix<double, Dim, Dim - 1> tangents;
  for (int d = 0, column = 0; d < Dim; ++d)
    if (d != across) tangents.col(column++) = jacobian.col(d);
  const double along = areaVector<Dim>(tangents).dot(jacobian.col(across));
  return (along > 0.0) == (face % 2 == 1) ? 1.0 : -1.0;
}

template class FaceQuadrature<2>;
template class FaceQuadrature<3>;
template double outwardSign(const Patch<2>&, FaceId);
template double outwardSign(const Patch<3>&, FaceId);

}  // namespace burnish::inline solid
