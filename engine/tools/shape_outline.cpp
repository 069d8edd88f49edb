#include "engine/tools/shape_outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/tools/outline_parts.h"

namespace burnish {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double kPi = std::numbers::pi;
constexpr double kPiece = kPi / 36.0;
constexpr int kAround = 72;

/// Unit vector at an angle from `a` towards `b`.
Vector3d direction(double angle, const Vector3d& a, const Vector3d& b) {
  return std::cos(angle) * a + std::sin(angle) * b;
}

Points arc(const Vector3d& center, double radius, const Vector3d& a, const Vector3d& b, double begin,
           double end) {
  const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(end - begin) / kPiece - 1e-9)));
  Points points;
  for (int k = 0; k <= pieces; ++k)
    points.push_back(center + radius * direction(begin + (end - begin) * k / pieces, a, b));
  return points;
}

/// A full circle, its last point left out.
Points ring(const Vector3d& center, double radius, const Vector3d& a, const Vector3d& b) {
  Points points = arc(center, radius, a, b, 0.0, 2.0 * kPi);
  points.pop_back();
  return points;
}

/// A rounded wedge from the end of one flank to that of the other, `across` to the right of somebody who
/// looks back from the front.
Points wedge(const Vector3d& tip, const Vector3d& front, const Vector3d& across, double halfAngle,
             double radius, double reach) {
  const double limit = 0.5 * kPi - halfAngle;
  Points points = arc(tip - radius * front, radius, front, across, -limit, limit);
  const Vector3d down = -std::cos(halfAngle) * front;
  points.insert(points.begin(), points.front() + reach * (down - std::sin(halfAngle) * across));
  points.push_back(points.back() + reach * (down + std::sin(halfAngle) * across));
  return points;
}

/// The point of a common surface near x. Where the normals of two parts cancel there may be none.
Vector3d onSurface(const Union& joined, Vector3d x) {
  constexpr double kFlattest = 0.1;
  for (int step = 0; step < 4; ++step) {
    const GapQuery query = joined.query(x);
    if (query.normal.norm() < kFlattest) break;
    x -= query.gap * query.normal / query.normal.squaredNorm();
  }
  return x;
}

class Outline {
 public:
  Outline(int dim, double reach) : dim_(dim), reach_(reach) {}

  SurfaceMesh operator()(const Plane& plane) const;
  SurfaceMesh operator()(const Cylinder& cylinder) const;
  SurfaceMesh operator()(const Sphere& sphere) const;
  SurfaceMesh operator()(const Edge& edge) const;
  SurfaceMesh operator()(const Cone& cone) const;
  SurfaceMesh operator()(const Torus& torus) const;
  SurfaceMesh operator()(const RoundedBox& box) const;
  SurfaceMesh operator()(const NurbsCurve& curve) const { return outlineOf(curve); }
  SurfaceMesh operator()(const NurbsSurface& surface) const { return outlineOf(surface); }
  SurfaceMesh operator()(const FacetedShape& faceted) const { return outlineOf(faceted); }
  SurfaceMesh operator()(const Die& die) const { return turnedOver(std::visit(*this, die.solid->shape)); }
  SurfaceMesh operator()(const Union& joined) const;

 private:
  /// A profile turned about an axis: its points by their distance from the axis and height along it.
  SurfaceMesh turned(const std::vector<Eigen::Vector2d>& profile, const Vector3d& center,
                     const Vector3d& axis, bool closed) const;

  int dim_;
  double reach_;
};

SurfaceMesh Outline::turned(const std::vector<Eigen::Vector2d>& profile, const Vector3d& center,
                            const Vector3d& axis, bool closed) const {
  const Vector3d h = axis.normalized(), a = h.unitOrthogonal(), b = h.cross(a);
  std::vector<Points> rings;
  for (const Eigen::Vector2d& p : profile) rings.push_back(ring(center + p.y() * h, p.x(), a, b));
  return strips(rings, true, closed);
}

SurfaceMesh Outline::operator()(const Plane& plane) const {
  const Vector3d n = plane.normal.normalized();
  if (dim_ == 2) {
    const Vector3d along(-n.y(), n.x(), 0.0);
    return line({plane.origin - reach_ * along, plane.origin + reach_ * along}, false);
  }
  const Vector3d a = reach_ * n.unitOrthogonal(), b = n.cross(a);
  return strips({{plane.origin - a - b, plane.origin + a - b}, {plane.origin - a + b, plane.origin + a + b}},
                false, false);
}

SurfaceMesh Outline::operator()(const Cylinder& cylinder) const {
  if (dim_ == 2)
    return line(ring(cylinder.center, cylinder.radius, Vector3d::UnitX(), Vector3d::UnitY()), true);
  return turned({{cylinder.radius, -reach_}, {cylinder.radius, reach_}}, cylinder.center, cylinder.axis,
                false);
}

SurfaceMesh Outline::operator()(const Sphere& sphere) const {
  std::vector<Eigen::Vector2d> profile;
  for (int k = 0; k <= kAround / 2; ++k)
    profile.emplace_back(sphere.radius * std::sin(k * kPiece), -sphere.radius * std::cos(k * kPiece));
  SurfaceMesh mesh = turned(profile, sphere.center, Vector3d::UnitZ(), false);
  mesh.closed = true;
  return mesh;
}

SurfaceMesh Outline::operator()(const Edge& edge) const {
  const Vector3d front = edge.direction.normalized();
  const Vector3d across = edge.along.cross(front).normalized();
  const Vector3d along = front.cross(across);
  const Points profile = wedge(edge.tip, front, across, edge.halfAngle, edge.radius, reach_);
  if (dim_ == 2) {
    const bool isRight = across.x() * -front.y() + across.y() * front.x() > 0.0;
    return line(isRight ? profile : Points(profile.rbegin(), profile.rend()), false);
  }
  std::vector<Points> rows(2);
  for (const Vector3d& p : profile) {
    rows[0].push_back(p - reach_ * along);
    rows[1].push_back(p + reach_ * along);
  }
  return strips(rows, false, false);
}

SurfaceMesh Outline::operator()(const Cone& cone) const {
  if (dim_ == 2)
    return (*this)(Edge{cone.tip, cone.direction, Vector3d::UnitZ(), cone.halfAngle, cone.radius});
  const Points half =
      wedge(Vector3d::Zero(), Vector3d::UnitY(), Vector3d::UnitX(), cone.halfAngle, cone.radius, reach_);
  std::vector<Eigen::Vector2d> profile;
  for (const Vector3d& p : half)
    if (p.x() >= 0.0) profile.emplace_back(p.x(), p.y());
  if (profile.front().x() > 0.0) profile.insert(profile.begin(), {0.0, 0.0});
  std::reverse(profile.begin(), profile.end());
  return turned(profile, cone.tip, cone.direction, false);
}

SurfaceMesh Outline::operator()(const Torus& torus) const {
  std::vector<Eigen::Vector2d> profile;
  for (int k = 0; k < kAround; ++k)
    profile.emplace_back(torus.radius + torus.tubeRadius * std::cos(k * kPiece),
                         torus.tubeRadius * std::sin(k * kPiece));
  return turned(profile, torus.center, torus.axis, true);
}

/// Its corners are those of the core box, grown by parts of a sphere (3D) or circle.
SurfaceMesh Outline::operator()(const RoundedBox& box) const {
  const auto corner = [&](double angle, double sideX, double sideY, double latitude, double sideZ) {
    const Vector3d side(sideX, sideY, sideZ);
    const Vector3d normal(std::cos(latitude) * std::cos(angle), std::cos(latitude) * std::sin(angle),
                          std::sin(latitude));
    Vector3d core = 0.5 * box.size - Vector3d::Constant(box.radius);
    if (dim_ == 2) core.z() = 0.0;
    return Vector3d(box.center + box.axes * (core.cwiseProduct(side) + box.radius * normal));
  };
  const int quarter = box.radius > 0.0 ? kAround / 4 : 0;
  const auto around = [&](double latitude, double sideZ) {
    Points points;
    for (int q = 0; q < 4; ++q)
      for (int k = 0; k <= quarter; ++k)
        points.push_back(corner(q * 0.5 * kPi + k * kPiece, q == 0 || q == 3 ? 1.0 : -1.0, q < 2 ? 1.0 : -1.0,
                                latitude, sideZ));
    return points;
  };
  if (dim_ == 2) return line(around(0.0, 0.0), true);
  std::vector<Points> rings;
  for (int k = -quarter; k <= 0; ++k) rings.push_back(around(k * kPiece, -1.0));
  for (int k = 0; k <= quarter; ++k) rings.push_back(around(k * kPiece, 1.0));
  rings.insert(rings.begin(),
               Points(rings.front().size(), box.center - 0.5 * box.size.z() * box.axes.col(2)));
  rings.push_back(Points(rings.front().size(), box.center + 0.5 * box.size.z() * box.axes.col(2)));
  SurfaceMesh mesh = strips(rings, true, false);
  mesh.closed = true;
  return mesh;
}

/// The parts without what is inside of other parts, cut finely and moved onto the common surface.
SurfaceMesh Outline::operator()(const Union& joined) const {
  std::vector<SurfaceMesh> outlines;
  for (const auto& part : joined.parts) {
    const auto others = [&](const Vector3d& x) {
      double smallest = reach_;
      for (const auto& other : joined.parts)
        if (other != part) smallest = std::min(smallest, queryGap(other->shape, x).gap);
      return smallest;
    };
    const double finest = joined.blend > 0.0 ? std::min(reach_ / 40.0, joined.blend / 4.0) : reach_ / 40.0;
    SurfaceMesh outline = clipped(refined(std::visit(*this, part->shape), finest), others);
    for (auto point : outline.points.colwise()) point = onSurface(joined, point);
    const auto offSurface = [&](const Vector3d& x) { return 0.1 * finest - std::abs(joined.query(x).gap); };
    outlines.push_back(clipped(outline, offSurface));
  }
  return together(outlines);
}

}  // namespace

SurfaceMesh outlineOf(const RigidShape& shape, int dim, double reach) {
  return std::visit(Outline(dim, reach), shape);
}

}  // namespace burnish
