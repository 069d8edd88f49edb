#include "engine/solid/follower_load.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace burnish::inline solid {
namespace {

Eigen::Matrix2d quarterTurn() {
  return (Eigen::Matrix2d() << 0.0, 1.0, -1.0, 0.0).finished();
}

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  return (Eigen::Matrix3d() << 0.0, -v(2), v(1), v(2), 0.0, -v(0), -v(1), v(0), 0.0).finished();
}

}  // namespace

template <int Dim>
FollowerLoad<Dim>::FollowerLoad(const Body<Dim>& body, int patch, FaceId side, FaceQuadrature<Dim> face,
                                Direction direction, Formula intensity, Schedule factor)
    : face_(std::move(face)),
      kind_(direction),
      intensity_(std::move(intensity)),
      factor_(std::move(factor)),
      axisymmetric_(body.axisymmetric),
      outward_(outwardSign(body.patches[static_cast<std::size_t>(patch)], side)) {
  forces_.setZero(Dim * body.numNodes);
}

template <int Dim>
std::vector<int> FollowerLoad<Dim>::unknowns(const typename FaceQuadrature<Dim>::Span& span) const {
  std::vector<int> result;
  for (const int a : span.functions)
    for (int d = 0; d < Dim; ++d) result.push_back(Dim * face_.nodes()[static_cast<std::size_t>(a)] + d);
  return result;
}

template <int Dim>
CouplingGroups FollowerLoad<Dim>::couplings() const {
  CouplingGroups groups;
  for (const auto& span : face_.spans()) groups.push_back(unknowns(span));
  return groups;
}

template <int Dim>
typename FollowerLoad<Dim>::Vector FollowerLoad<Dim>::direction(const Tangents& tangents) const {
  if constexpr (Dim == 2)
    if (kind_ == Direction::Shear) return tangents;
  return -outward_ * areaVector<Dim>(tangents);
}

template <int Dim>
typename FollowerLoad<Dim>::Matrix FollowerLoad<Dim>::derivative(const Tangents& tangents,
                                                                 int tangent) const {
  if constexpr (Dim == 2)
    return kind_ == Direction::Shear ? Matrix::Identity() : Matrix(-outward_ * quarterTurn());
  else
    return -outward_ * (tangent == 0 ? Matrix(-crossMatrix(tangents.col(1))) : crossMatrix(tangents.col(0)));
}

template <int Dim>
bool FollowerLoad<Dim>::evaluate(double time, const Eigen::VectorXd& x, Assembly& out) {
  const double t = std::max(time, 0.0);  // lifted tools come down before
  const double factor = factor_.times.empty() ? 1.0 : factor_(t);
  forces_.setZero();
  for (std::size_t e = 0; e < face_.spans().size(); ++e) {
    const auto& span = face_.spans()[e];
    const auto n = span.R.rows();
    const Eigen::MatrixXd reference = face_.points()(Eigen::all, span.functions);
    Eigen::MatrixXd current = reference;
    for (Eigen::Index a = 0; a < n; ++a)
      current.col(a) += x.template segment<Dim>(
          Dim * face_.nodes()[static_cast<std::size_t>(span.functions[static_cast<std::size_t>(a)])]);

    Eigen::VectorXd f = Eigen::VectorXd::Zero(Dim * n);
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(Dim * n, Dim * n);
    for (Eigen::Index q = 0; q < span.R.cols(); ++q) {
      Eigen::Vector3d X = Eigen::Vector3d::Zero();
      X.head<Dim>() = reference * span.R.col(q);
      const auto dR = span.dR.template middleCols<Dim - 1>((Dim - 1) * q);
      const Tangents tangents = current * dR;
      const double radius = current.row(0).dot(span.R.col(q));
      const double ring = axisymmetric_ ? 2.0 * std::numbers::pi : 1.0;
      const double w = factor * intensity_(X, t) * span.ruleWeights(q) * ring;
      const double extent = axisymmetric_ ? radius : 1.0;
      const Vector force = direction(tangents);
      for (Eigen::Index a = 0; a < n; ++a) {
        f.segment<Dim>(Dim * a) += w * extent * span.R(a, q) * force;
        if (out.system == nullptr) continue;
        for (Eigen::Index b = 0; b < n; ++b) {
          Matrix block = Matrix::Zero();
          for (int k = 0; k < Dim - 1; ++k) block += extent * dR(b, k) * derivative(tangents, k);
          if (axisymmetric_) block.col(0) += span.R(b, q) * force;
          K.block<Dim, Dim>(Dim * a, Dim * b) -= w * span.R(a, q) * block;
        }
      }
    }
    const auto group = unknowns(span);
    for (std::size_t i = 0; i < group.size(); ++i) forces_(group[i]) += f(static_cast<Eigen::Index>(i));
    if (out.system != nullptr) out.system->add(out.term, e, K);
  }
  out.force.head(forces_.size()) -= forces_;
  return true;
}

template <int Dim>
void FollowerLoad<Dim>::requireFinite(const std::vector<double>& times) const {
  Eigen::Index count = 0;
  for (const auto& span : face_.spans()) count += span.R.cols();
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, count);
  for (Eigen::Index next = 0; const auto& span : face_.spans()) {
    points.template block<Dim, Eigen::Dynamic>(0, next, Dim, span.R.cols()) =
        face_.points()(Eigen::all, span.functions) * span.R;
    next += span.R.cols();
  }
  burnish::requireFinite({intensity_}, points, times);
}

template class FollowerLoad<2>;
template class FollowerLoad<3>;

}  // namespace burnish::inline solid
