#include "engine/tools/outline_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace burnish::inline tools {
namespace {

using Eigen::Vector3d;

/// Collects points and cells.
struct Builder {
  std::vector<Vector3d> points;
  std::vector<std::array<int, 3>> cells;

  int add(const Vector3d& point) {
    points.push_back(point);
    return static_cast<int>(points.size()) - 1;
  }

  SurfaceMesh finish(Eigen::Index corners, bool closed) const {
    SurfaceMesh mesh;
    mesh.closed = closed;
    mesh.points.resize(3, static_cast<Eigen::Index>(points.size()));
    for (std::size_t k = 0; k < points.size(); ++k) mesh.points.col(static_cast<Eigen::Index>(k)) = points[k];
    mesh.cells.resize(corners, static_cast<Eigen::Index>(cells.size()));
    for (std::size_t c = 0; c < cells.size(); ++c)
      for (Eigen::Index k = 0; k < corners; ++k)
        mesh.cells(k, static_cast<Eigen::Index>(c)) = cells[c][static_cast<std::size_t>(k)];
    return mesh;
  }
};

/// Unit vector at an angle from `a` towards `b`.
Vector3d directionAt(double angle, const Vector3d& a, const Vector3d& b) {
  return std::cos(angle) * a + std::sin(angle) * b;
}

OutlinePoints arc(const Vector3d& center, double radius, const Vector3d& a, const Vector3d& b, double begin,
                  double end) {
  const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(end - begin) / kPieceAngle - 1e-9)));
  OutlinePoints points;
  for (int k = 0; k <= pieces; ++k)
    points.push_back(center + radius * directionAt(begin + (end - begin) * k / pieces, a, b));
  return points;
}

}  // namespace

OutlinePoints ring(const Vector3d& center, double radius, const Vector3d& a, const Vector3d& b) {
  OutlinePoints points = arc(center, radius, a, b, 0.0, 2.0 * std::numbers::pi);
  points.pop_back();
  return points;
}

OutlinePoints wedge(const Vector3d& tip, const Vector3d& front, const Vector3d& across, double halfAngle,
                    double radius, double reach) {
  const double limit = 0.5 * std::numbers::pi - halfAngle;
  OutlinePoints points = arc(tip - radius * front, radius, front, across, -limit, limit);
  const Vector3d down = -std::cos(halfAngle) * front;
  points.insert(points.begin(), points.front() + reach * (down - std::sin(halfAngle) * across));
  points.push_back(points.back() + reach * (down + std::sin(halfAngle) * across));
  return points;
}

SurfaceMesh revolved(const std::vector<Eigen::Vector2d>& profile, const Vector3d& center,
                     const Vector3d& axis, bool closed) {
  const Vector3d h = axis.normalized(), a = h.unitOrthogonal(), b = h.cross(a);
  std::vector<OutlinePoints> rings;
  for (const Eigen::Vector2d& p : profile) rings.push_back(ring(center + p.y() * h, p.x(), a, b));
  return strips(rings, true, closed);
}

SurfaceMesh line(const std::vector<Vector3d>& points, bool closed) {
  Builder builder{points, {}};
  const int n = static_cast<int>(points.size());
  for (int k = 0; k + (closed ? 0 : 1) < n; ++k)
    if (points[static_cast<std::size_t>(k)] != points[static_cast<std::size_t>((k + 1) % n)])
      builder.cells.push_back({k, (k + 1) % n, 0});
  return builder.finish(2, closed);
}

SurfaceMesh strips(const std::vector<std::vector<Vector3d>>& rows, bool rings, bool joined) {
  Builder builder;
  for (const auto& row : rows) builder.points.insert(builder.points.end(), row.begin(), row.end());
  const int n = static_cast<int>(rows.front().size()), m = static_cast<int>(rows.size());
  const auto addTriangle = [&](int a, int b, int c) {
    const auto at = [&](int k) -> const Vector3d& { return builder.points[static_cast<std::size_t>(k)]; };
    const Vector3d ab = at(b) - at(a), ac = at(c) - at(a);
    if (ab.cross(ac).norm() > 1e-12 * std::max(ab.squaredNorm(), ac.squaredNorm()))
      builder.cells.push_back({a, b, c});
  };
  for (int j = 0; j + (joined ? 0 : 1) < m; ++j)
    for (int i = 0; i + (rings ? 0 : 1) < n; ++i) {
      const int next = (i + 1) % n, above = (j + 1) % m;
      addTriangle(j * n + i, j * n + next, above * n + next);
      addTriangle(j * n + i, above * n + next, above * n + i);
    }
  return builder.finish(3, rings && joined);
}

SurfaceMesh turnedOver(SurfaceMesh mesh) {
  const Eigen::RowVectorXi first = mesh.cells.row(0);
  mesh.cells.row(0) = mesh.cells.row(1);
  mesh.cells.row(1) = first;
  return mesh;
}

SurfaceMesh refined(const SurfaceMesh& mesh, double longest) {
  constexpr int kMostParts = 64;
  Builder builder;
  const Eigen::Index corners = mesh.cells.rows();
  for (Eigen::Index c = 0; c < mesh.cells.cols(); ++c) {
    const auto at = [&](Eigen::Index k) -> Vector3d { return mesh.points.col(mesh.cells(k % corners, c)); };
    double length = 0.0;
    for (Eigen::Index k = 0; k < corners; ++k) length = std::max(length, (at(k + 1) - at(k)).norm());
    const int n = std::clamp(static_cast<int>(std::ceil(length / longest)), 1, kMostParts);
    if (corners == 2) {
      for (int k = 0; k < n; ++k) {
        const int a = builder.add(at(0) + (at(1) - at(0)) * k / n);
        builder.cells.push_back({a, builder.add(at(0) + (at(1) - at(0)) * (k + 1) / n), 0});
      }
      continue;
    }
    const auto point = [&](int i, int j) {
      return builder.add(at(0) + (at(1) - at(0)) * i / n + (at(2) - at(0)) * j / n);
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        builder.cells.push_back({point(i, j), point(i + 1, j), point(i, j + 1)});
        if (i + j + 2 <= n) builder.cells.push_back({point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
      }
  }
  return builder.finish(corners, mesh.closed);
}

SurfaceMesh clipped(const SurfaceMesh& mesh, const std::function<double(const Vector3d&)>& function) {
  Builder builder;
  const Eigen::Index corners = mesh.cells.rows();
  const auto crossing = [&](Vector3d a, Vector3d b) {  // from a kept point to one that is not
    for (int k = 0; k < 40; ++k) {
      const Vector3d middle = 0.5 * (a + b);
      (function(middle) >= 0.0 ? a : b) = middle;
    }
    return a;
  };
  Eigen::VectorXd values(mesh.points.cols());
  for (Eigen::Index k = 0; k < values.size(); ++k) values(k) = function(mesh.points.col(k));
  for (Eigen::Index c = 0; c < mesh.cells.cols(); ++c) {
    std::vector<int> kept;  // the corners of the part of the cell that is left, in order
    for (Eigen::Index k = 0; k < corners; ++k) {
      const int a = mesh.cells(k, c), b = mesh.cells((k + 1) % corners, c);
      if (values(a) >= 0.0) kept.push_back(builder.add(mesh.points.col(a)));
      if (corners == 2 && k == 1) continue;
      if ((values(a) >= 0.0) != (values(b) >= 0.0))
        kept.push_back(builder.add(values(a) >= 0.0 ? crossing(mesh.points.col(a), mesh.points.col(b))
                                                    : crossing(mesh.points.col(b), mesh.points.col(a))));
    }
    if (corners == 2 && kept.size() == 2) builder.cells.push_back({kept[0], kept[1], 0});
    for (std::size_t k = 2; corners == 3 && k < kept.size(); ++k)
      builder.cells.push_back({kept[0], kept[k - 1], kept[k]});
  }
  return builder.finish(corners, mesh.closed);
}

bool isSolid(const SurfaceMesh& mesh) {
  double size = 0.0;  // twice the area, or six times the volume
  for (const auto& cell : mesh.cells.colwise()) {
    const Vector3d a = mesh.points.col(cell(0)), b = mesh.points.col(cell(1));
    size += cell.size() == 2 ? a.cross(b).z() : a.dot(b.cross(mesh.points.col(cell(2)).eval()));
  }
  return mesh.closed && size > 0.0;
}

SurfaceMesh together(const std::vector<SurfaceMesh>& meshes) {
  SurfaceMesh all = meshes.front();
  for (auto mesh = meshes.begin() + 1; mesh != meshes.end(); ++mesh) {
    const auto firstPoint = all.points.cols(), firstCell = all.cells.cols();
    all.points.conservativeResize(3, firstPoint + mesh->points.cols());
    all.points.rightCols(mesh->points.cols()) = mesh->points;
    all.cells.conservativeResize(all.cells.rows(), firstCell + mesh->cells.cols());
    all.cells.rightCols(mesh->cells.cols()) = mesh->cells.array() + static_cast<int>(firstPoint);
    all.closed = all.closed && mesh->closed;
  }
  return all;
}

}  // namespace burnish::inline tools
