#include "engine/tools/curved_facets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace burnish::inline tools {
namespace {

/// Two pieces whose normals differ by more are two sides of a crease.
const double kCreaseCosine = std::cos(30.0 * std::numbers::pi / 180.0);

/// Shares of a corner below which a point is on the opposite edge.
constexpr double kOnEdge = 1e-12;

}  // namespace

CurvedFacets::CurvedFacets(SurfaceMesh surface, std::vector<Eigen::Matrix3d> normals)
    : surface_(std::move(surface)),
      corners_(static_cast<int>(surface_.cells.rows())),
      normals_(std::move(normals)),
      tree_(surface_.points, surface_.cells) {
  findNeighbours();
  findNormals();
  findBends();
}

Eigen::Vector3d CurvedFacets::facetNormal(Eigen::Index cell) const {
  const auto at = [&](Eigen::Index k) -> Eigen::Vector3d {
    return surface_.points.col(surface_.cells(k, cell));
  };
  if (corners_ == 2) return (at(1) - at(0)).cross(Eigen::Vector3d::UnitZ()).normalized();
  return (at(1) - at(0)).cross(at(2) - at(0)).normalized();
}

void CurvedFacets::findNeighbours() {
  neighbours_ = Eigen::MatrixXi::Constant(corners_, surface_.cells.cols(), -1);
  std::map<std::pair<int, int>, std::pair<Eigen::Index, int>> open;
  for (Eigen::Index c = 0; c < surface_.cells.cols(); ++c)
    for (int k = 0; k < corners_; ++k) {
      const int a = surface_.cells(k, c), b = corners_ == 2 ? a : surface_.cells((k + 1) % 3, c);
      const auto [it, isNew] = open.try_emplace(std::minmax(a, b), c, k);
      if (isNew) continue;
      neighbours_(k, c) = static_cast<int>(it->second.first);
      neighbours_(it->second.second, it->second.first) = static_cast<int>(c);
    }
  isAtRim_.assign(static_cast<std::size_t>(surface_.points.cols()), false);
  for (Eigen::Index c = 0; c < surface_.cells.cols(); ++c)
    for (int k = 0; k < corners_; ++k)
      if (neighbours_(k, c) < 0)
        for (const int end : {k, corners_ == 2 ? k : (k + 1) % 3})
          isAtRim_[static_cast<std::size_t>(surface_.cells(end, c))] = true;
}

bool CurvedFacets::isCrease(Eigen::Index cell, Eigen::Index neighbour) const {
  return facetNormal(cell).dot(facetNormal(neighbour)) < kCreaseCosine;
}

/// What a piece adds to the normal at one of its corners: Max's weight, for a segment the inverse length.
Eigen::Vector3d CurvedFacets::cornerNormal(Eigen::Index cell, int corner) const {
  const auto at = [&](int k) -> Eigen::Vector3d {
    return surface_.points.col(surface_.cells((corner + k) % corners_, cell));
  };
  const Eigen::Vector3d a = at(1) - at(0);
  if (corners_ == 2) return facetNormal(cell) / a.norm();
  const Eigen::Vector3d b = at(2) - at(0);
  return a.cross(b) / (a.squaredNorm() * b.squaredNorm());
}

/// Sum over the fan of pieces around a corner, both ways up to a crease or a rim.
Eigen::Vector3d CurvedFacets::fanNormal(Eigen::Index cell, int corner) const {
  const int vertex = surface_.cells(corner, cell);
  Eigen::Vector3d sum = cornerNormal(cell, corner);
  for (int way = 0; way < corners_ - 1; ++way) {
    Eigen::Index at = cell;
    int k = corner;
    while (true) {
      const Eigen::Index next = neighbours_(way == 0 ? k : (k + 2) % 3, at);
      if (next < 0 || isCrease(at, next)) break;
      if (next == cell) return sum;
      const auto points = surface_.cells.col(next);
      k = static_cast<int>(std::find(points.begin(), points.end(), vertex) - points.begin());
      sum += cornerNormal(next, k);
      at = next;
      if (corners_ == 2) break;
    }
  }
  return sum;
}

void CurvedFacets::findNormals() {
  const Eigen::Index cells = surface_.cells.cols();
  normals_.resize(static_cast<std::size_t>(cells), Eigen::Matrix3d::Zero());
  means_.assign(static_cast<std::size_t>(surface_.points.cols()), Eigen::Vector3d::Zero());
  for (Eigen::Index c = 0; c < cells; ++c)
    for (int k = 0; k < corners_; ++k) {
      auto normal = normals_[static_cast<std::size_t>(c)].col(k);
      if (normal.isZero(0.0)) normal = fanNormal(c, k).normalized();
      const auto at = [&](int corner) -> Eigen::Vector3d {
        return surface_.points.col(surface_.cells(corner % corners_, c));
      };
      const Eigen::Vector3d a = at(k + 1) - at(k), b = at(k + 2) - at(k);
      const double angle = corners_ == 2 ? 1.0 : std::atan2(a.cross(b).norm(), a.dot(b));
      means_[static_cast<std::size_t>(surface_.cells(k, c))] += angle * facetNormal(c);
    }
}

/// An edge between a and b with normals n_a, n_b bends in their mean direction s = n_a + n_b:
/// c = s ((n_a - n_b)·(b - a)) / s·s, on a circle its parabola.
void CurvedFacets::findBends() {
  bends_.assign(normals_.size(), Eigen::Matrix3d::Zero());
  for (std::size_t c = 0; c < bends_.size(); ++c)
    for (int k = 0; k < numEdges(); ++k) {
      const auto cell = static_cast<Eigen::Index>(c);
      const Eigen::Vector3d along = surface_.points.col(surface_.cells(edgeEnd(k), cell)) -
                                    surface_.points.col(surface_.cells(edgeBegin(k), cell));
      const Eigen::Vector3d na = normals_[c].col(edgeBegin(k)), nb = normals_[c].col(edgeEnd(k));
      const Eigen::Vector3d s = na + nb;
      bends_[c].col(k) = s * (na - nb).dot(along) / s.squaredNorm();
    }
}

Eigen::Vector3d CurvedFacets::position(Eigen::Index cell, const Eigen::Vector3d& weights) const {
  Eigen::Vector3d y = Eigen::Vector3d::Zero();
  for (int k = 0; k < corners_; ++k) y += weights(k) * surface_.points.col(surface_.cells(k, cell));
  const Eigen::Matrix3d& bends = bends_[static_cast<std::size_t>(cell)];
  for (int k = 0; k < numEdges(); ++k) y -= weights(edgeBegin(k)) * weights(edgeEnd(k)) * bends.col(k);
  return y;
}

/// Derivatives by the weights of corners 1 and 2 (corner 0 takes the rest).
Eigen::Matrix<double, 3, 2> CurvedFacets::tangents(Eigen::Index cell, const Eigen::Vector3d& weights) const {
  Eigen::Matrix3d byWeight = Eigen::Matrix3d::Zero();
  const Eigen::Matrix3d& bends = bends_[static_cast<std::size_t>(cell)];
  for (int k = 0; k < corners_; ++k) byWeight.col(k) = surface_.points.col(surface_.cells(k, cell));
  for (int k = 0; k < numEdges(); ++k) {
    byWeight.col(edgeBegin(k)) -= weights(edgeEnd(k)) * bends.col(k);
    byWeight.col(edgeEnd(k)) -= weights(edgeBegin(k)) * bends.col(k);
  }
  Eigen::Matrix<double, 3, 2> result;
  result.col(0) = byWeight.col(1) - byWeight.col(0);
  result.col(1) =
      corners_ == 2 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d(byWeight.col(2) - byWeight.col(0));
  return result;
}

CurvedFacets::Foot CurvedFacets::footAt(Eigen::Index cell, const Eigen::Vector3d& weights,
                                        const Eigen::Vector3d& x) const {
  Foot foot{cell, weights, position(cell, weights), 0.0};
  foot.distance = (foot.y - x).norm();
  return foot;
}

/// Closest point of a bent edge: Newton's method for its only parameter, without curvature where that is not
/// convex.
CurvedFacets::Foot CurvedFacets::onEdge(Eigen::Index cell, int edge, const Eigen::Vector3d& start,
                                        const Eigen::Vector3d& x) const {
  const int a = edgeBegin(edge), b = edgeEnd(edge);
  const Eigen::Vector3d begin = surface_.points.col(surface_.cells(a, cell));
  const Eigen::Vector3d along = surface_.points.col(surface_.cells(b, cell)) - begin;
  const Eigen::Vector3d c = bends_[static_cast<std::size_t>(cell)].col(edge);
  double t = std::clamp(start(b) / std::max(start(a) + start(b), kOnEdge), 0.0, 1.0);
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Eigen::Vector3d r = begin + t * along - t * (1.0 - t) * c - x;
    const Eigen::Vector3d tangent = along - (1.0 - 2.0 * t) * c;
    const double stretch = tangent.squaredNorm(), slope = tangent.squaredNorm() + 2.0 * r.dot(c);
    const double next = std::clamp(t - r.dot(tangent) / (slope > 0.1 * stretch ? slope : stretch), 0.0, 1.0);
    const double moved = std::abs(next - t);
    t = next;
    if (moved < 1e-14) break;
  }
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  weights(a) = 1.0 - t;
  weights(b) = t;
  return footAt(cell, weights, x);
}

/// Newton's method inside of a triangle from a foot; false if it leaves it.
bool CurvedFacets::inside(Foot& foot, const Eigen::Vector3d& x) const {
  const Eigen::Matrix3d& bends = bends_[static_cast<std::size_t>(foot.cell)];
  // Second derivatives by the weights of corners 1 and 2.
  const Eigen::Vector3d y11 = 2.0 * bends.col(0), y22 = 2.0 * bends.col(2);
  const Eigen::Vector3d y12 = bends.col(0) - bends.col(1) + bends.col(2);
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Eigen::Vector3d r = foot.y - x;
    const Eigen::Matrix<double, 3, 2> dy = tangents(foot.cell, foot.weights);
    Eigen::Matrix2d hessian = dy.transpose() * dy;
    Eigen::Matrix2d curved = hessian;
    curved(0, 0) += r.dot(y11);
    curved(1, 1) += r.dot(y22);
    curved(0, 1) += r.dot(y12);
    curved(1, 0) = curved(0, 1);
    if (curved(0, 0) > 0.0 && curved.determinant() > 0.1 * hessian.determinant()) hessian = curved;
    const Eigen::Vector2d step = -hessian.inverse() * dy.transpose() * r;
    const Eigen::Vector3d weights = foot.weights + Eigen::Vector3d(-step.sum(), step(0), step(1));
    if (weights.minCoeff() < -0.5) return false;
    foot = footAt(foot.cell, weights, x);
    if (step.cwiseAbs().maxCoeff() < 1e-13) break;
  }
  return foot.weights.minCoeff() >= 0.0;
}

CurvedFacets::Foot CurvedFacets::closestOf(Eigen::Index cell, const Eigen::Vector3d& near,
                                           const Eigen::Vector3d& x) const {
  const auto at = [&](int k) -> Eigen::Vector3d { return surface_.points.col(surface_.cells(k, cell)); };
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  if (corners_ == 2) {
    start(1) = (near - at(0)).dot(at(1) - at(0)) / (at(1) - at(0)).squaredNorm();
    start(0) = 1.0 - start(1);
    return onEdge(cell, 0, start, x);
  }
  Eigen::Matrix<double, 3, 2> edges;
  edges << at(1) - at(0), at(2) - at(0);
  const Eigen::Vector2d share = (edges.transpose() * edges).inverse() * edges.transpose() * (near - at(0));
  start << 1.0 - share.sum(), share;
  start = start.cwiseMax(0.0);
  start /= start.sum();
  Foot best = footAt(cell, start, x);
  if (inside(best, x)) return best;
  best = onEdge(cell, 0, start, x);
  for (int edge = 1; edge < 3; ++edge)
    if (const Foot other = onEdge(cell, edge, start, x); other.distance < best.distance) best = other;
  return best;
}

CurvedFacets::Answer CurvedFacets::answerAt(const Foot& foot, const Eigen::Vector3d& x) const {
  const Eigen::Vector3d away = x - foot.y;
  const Eigen::Matrix<double, 3, 2> dy = tangents(foot.cell, foot.weights);
  const Eigen::Vector3d own = dy.col(0).cross(dy.col(1)).normalized();
  const Answer straight{away.dot(own), own};
  Eigen::Vector3d side = Eigen::Vector3d::Zero();
  int on = 0;
  for (int k = 0; k < corners_; ++k) {
    // Edge k has no share of the corner opposite to it, which is k + 2; in 2D corner k has all of the share.
    const double share = corners_ == 2 ? 1.0 - foot.weights(k) : foot.weights((k + 2) % 3);
    if (share > kOnEdge) continue;
    const int neighbour = neighbours_(k, foot.cell);
    if (neighbour < 0) return straight;
    side += facetNormal(foot.cell) + facetNormal(neighbour);
    ++on;
  }
  if (on == 0 || foot.distance == 0.0) return straight;
  Eigen::Index corner = 0;
  if (foot.weights.maxCoeff(&corner) > 1.0 - kOnEdge) {
    const auto point = static_cast<std::size_t>(surface_.cells(corner, foot.cell));
    if (isAtRim_[point]) return straight;
    side = means_[point];
  }
  const double sign = away.dot(side) >= 0.0 ? 1.0 : -1.0;
  return {sign * foot.distance, sign * away / foot.distance};
}

CurvedFacets::Answer CurvedFacets::query(const Eigen::Vector3d& x) const {
  constexpr int kSteps = 6;
  const FacetTree::Hit hit = tree_.nearest(x);
  Foot best = closestOf(hit.cell, hit.point, x);
  // The patch over the nearest straight piece may end before the closest point is reached.
  for (int step = 0; step < kSteps; ++step) {
    Foot next = best;
    for (int k = 0; k < corners_; ++k) {
      const double share = corners_ == 2 ? 1.0 - best.weights(k) : best.weights((k + 2) % 3);
      const int neighbour = neighbours_(k, best.cell);
      if (share > kOnEdge || neighbour < 0) continue;
      const Foot other = closestOf(neighbour, best.y, x);
      if (other.distance < next.distance * (1.0 - 1e-12)) next = other;
    }
    if (next.cell == best.cell) break;
    best = next;
  }
  return answerAt(best, x);
}

}  // namespace burnish::inline tools
