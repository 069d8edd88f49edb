#include "engine/tools/faceted_distance.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace burnish::inline tools {
namespace {

/// Farther from the surface than this many grid spacings the distance is not smoothed: far beyond the reach
/// of basis functions that touch, so that gap, normal and curvature belong together wherever pressure acts.
constexpr double kFar = 64.0;

double medianEdge(const SurfaceMesh& surface) {
  std::vector<double> lengths;
  for (Eigen::Index c = 0; c < surface.cells.cols(); ++c)
    for (Eigen::Index k = 0; k < surface.cells.rows(); ++k) {
      const int a = surface.cells(k, c), b = surface.cells((k + 1) % surface.cells.rows(), c);
      lengths.push_back((surface.points.col(b) - surface.points.col(a)).norm());
    }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

double defaultSpacing(const SurfaceMesh& surface) {
  const Eigen::Vector3d extent = surface.points.rowwise().maxCoeff() - surface.points.rowwise().minCoeff();
  // The extent of an open surface says little about the size of what presses: it may go far beyond the body.
  const double size =
      surface.closed ? extent.head(surface.cells.rows()).minCoeff() / 32.0 : extent.maxCoeff() / 256.0;
  return std::min(medianEdge(surface), size);
}

/// The four cubic B-splines on a unit interval: rows value, first and second derivative.
Eigen::Matrix<double, 3, 4> cubicSplines(double u) {
  const double v = 1.0 - u;
  Eigen::Matrix<double, 3, 4> N;
  N.row(0) << v * v * v, 3.0 * u * u * u - 6.0 * u * u + 4.0, 3.0 * v * v * v - 6.0 * v * v + 4.0, u * u * u;
  N.row(1) << -3.0 * v * v, 9.0 * u * u - 12.0 * u, -9.0 * v * v + 12.0 * v, 3.0 * u * u;
  N.row(2) << 6.0 * v, 18.0 * u - 12.0, 18.0 * v - 12.0, 6.0 * u;
  return N / 6.0;
}

}  // namespace

FacetedDistance::FacetedDistance(SurfaceMesh surface, std::optional<double> smoothing,
                                 std::vector<Eigen::Matrix3d> normals)
    : facets_(std::move(surface), std::move(normals)),
      dim_(static_cast<int>(facets_.surface().cells.rows())),
      spacing_(smoothing.value_or(defaultSpacing(facets_.surface()))) {}

std::size_t FacetedDistance::NodeHash::operator()(const Node& node) const {
  std::uint64_t hash = 0;
  for (const std::int64_t i : node) {
    hash = (hash ^ static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return hash;
}

double FacetedDistance::bulge() const {
  // Of the spacing. On the faces of a wedge of 150, 90, 45 degrees the spline is 0.031, 0.093, 0.106 lower than the
  // distance; a corner of three faces adds to that.
  constexpr double kBulge = 0.2;
  return kBulge * spacing_;
}

double FacetedDistance::sample(const Node& node) const {
  const auto [it, isNew] = samples_.try_emplace(node, 0.0);
  if (isNew)
    it->second =
        facets_
            .query(spacing_ * Eigen::Vector3d(static_cast<double>(node[0]), static_cast<double>(node[1]),
                                              static_cast<double>(node[2])))
            .gap;
  return it->second;
}

double FacetedDistance::coefficient(const Node& node) const {
  const auto known = coefficients_.find(node);
  if (known != coefficients_.end()) return known->second;
  constexpr std::array<double, 3> share{-1.0 / 6.0, 8.0 / 6.0, -1.0 / 6.0};
  double sum = 0.0;
  for (int k = 0; k < (dim_ == 3 ? 27 : 9); ++k) {
    Node at = node;
    double weight = 1.0;
    for (int d = 0, rest = k; d < dim_; ++d, rest /= 3) {
      at[static_cast<std::size_t>(d)] += rest % 3 - 1;
      weight *= share[static_cast<std::size_t>(rest % 3)];
    }
    sum += weight * sample(at);
  }
  coefficients_.emplace(node, sum);
  return sum;
}

GapQuery FacetedDistance::query(const Eigen::Vector3d& x) const {
  Node first{}, nearest{};
  std::array<Eigen::Matrix<double, 3, 4>, 3> N;
  for (int d = 0; d < dim_; ++d) {
    const auto k = static_cast<std::size_t>(d);
    const double s = x(d) / spacing_;
    const double below = std::floor(s);
    first[k] = static_cast<std::int64_t>(below) - 1;
    nearest[k] = static_cast<std::int64_t>(std::round(s));
    N[k] = cubicSplines(s - below);
  }
  if (std::abs(sample(nearest)) > kFar * spacing_) {
    const CurvedFacets::Answer direct = facets_.query(x);
    return {direct.gap, direct.normal, Eigen::Matrix3d::Zero()};
  }
  if (dim_ == 2) N[2] << Eigen::Vector4d(1, 0, 0, 0).transpose(), Eigen::Matrix<double, 2, 4>::Zero();
  GapQuery answer;
  for (int k = 0; k < (dim_ == 3 ? 4 : 1); ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) {
        const double c = coefficient({first[0] + i, first[1] + j, first[2] + k});
        const Eigen::Vector3d u = N[0].col(i), v = N[1].col(j), w = N[2].col(k);
        answer.gap += c * u(0) * v(0) * w(0);
        answer.normal += c * Eigen::Vector3d(u(1) * v(0) * w(0), u(0) * v(1) * w(0), u(0) * v(0) * w(1));
        answer.dNormal.diagonal() +=
            c * Eigen::Vector3d(u(2) * v(0) * w(0), u(0) * v(2) * w(0), u(0) * v(0) * w(2));
        answer.dNormal(0, 1) += c * u(1) * v(1) * w(0);
        answer.dNormal(0, 2) += c * u(1) * v(0) * w(1);
        answer.dNormal(1, 2) += c * u(0) * v(1) * w(1);
      }
  answer.dNormal.triangularView<Eigen::StrictlyLower>() =
      answer.dNormal.transpose().triangularView<Eigen::StrictlyLower>();
  answer.normal /= spacing_;
  answer.dNormal /= spacing_ * spacing_;
  return answer;
}

}  // namespace burnish::inline tools
