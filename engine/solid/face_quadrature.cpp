#include "engine/solid/face_quadrature.h"

#include <algorithm>
#include <utility>

#include "engine/solid/span_quadrature.h"

namespace burnish {
namespace {

/// Length of a tangent, or area spanned by two.
template <int Dim>
double surfaceElement(const Eigen::Matrix<double, Dim, Dim - 1>& tangents) {
  if constexpr (Dim == 2)
    return tangents.norm();
  else
    return tangents.col(0).cross(tangents.col(1)).norm();
}

}  // namespace

template <int Dim>
FaceQuadrature<Dim>::FaceQuadrature(const Body<Dim>& body, int patch, FaceId face, int pointsPerDirection) {
  const auto& volume = body.patches[static_cast<std::size_t>(patch)];
  const auto trace = tracePatch(volume, face);
  for (const int a : faceFunctions(volume.basis(), face))
    nodes_.push_back(body.nodes[static_cast<std::size_t>(patch)][static_cast<std::size_t>(a)]);
  points_ = trace.points();

  int degree = 1;
  for (int d = 0; d < Dim - 1; ++d) degree = std::max(degree, trace.basis().direction(d).degree());
  for (int e = 0; e < trace.basis().numSpans(); ++e) {
    const auto rule = spanRule(trace.basis(), e, pointsPerDirection > 0 ? pointsPerDirection : degree + 1);
    Span span{trace.basis().spanFunctions(e), numPoints_, {}, {}};
    const auto n = static_cast<Eigen::Index>(span.functions.size());
    const auto Q = static_cast<Eigen::Index>(rule.points.size());
    span.R.resize(n, Q);
    span.weights.resize(Q);
    const Eigen::MatrixXd points = points_(Eigen::all, span.functions);
    for (Eigen::Index q = 0; q < Q; ++q) {
      const auto shape = trace.shape(e, rule.points[static_cast<std::size_t>(q)]);
      const Eigen::Matrix<double, Dim, Dim - 1> tangents = points * shape.dR;
      span.R.col(q) = shape.R;
      span.weights(q) = rule.weights[static_cast<std::size_t>(q)] * surfaceElement<Dim>(tangents);
    }
    numPoints_ += static_cast<int>(Q);
    spans_.push_back(std::move(span));
  }
}

template class FaceQuadrature<2>;
template class FaceQuadrature<3>;

}  // namespace burnish
