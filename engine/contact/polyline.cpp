#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "engine/contact/surface_file.h"
#include "engine/core/error.h"

namespace burnish {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Whether the segments ab and cd have a point in common.
bool meet(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
          const Eigen::Vector2d& d) {
  const auto side = [](const auto& p, const auto& q, const auto& r) {
    const double s = cross(q - p, r - p);
    return s > 0.0 ? 1 : s < 0.0 ? -1 : 0;
  };
  const auto covers = [](const auto& p, const auto& q, const auto& r) {
    return ((r - p).cwiseProduct(r - q)).maxCoeff() <= 0.0;
  };
  const int c1 = side(a, b, c), d1 = side(a, b, d), a1 = side(c, d, a), b1 = side(c, d, b);
  if (c1 * d1 < 0 && a1 * b1 < 0) return true;
  return (c1 == 0 && covers(a, b, c)) || (d1 == 0 && covers(a, b, d)) || (a1 == 0 && covers(c, d, a)) ||
         (b1 == 0 && covers(c, d, b));
}

void requireSimple(const std::vector<Eigen::Vector2d>& points, bool closed) {
  const std::size_t n = points.size(), segments = closed ? n : n - 1;
  for (std::size_t i = 0; i < segments; ++i)
    if (points[i] == points[(i + 1) % n])
      throw Error(fmt::format("points {} and {} are both ({}, {})", i + 1, (i + 1) % n + 1, points[i].x(),
                              points[i].y()));
  for (std::size_t i = 0; i < segments; ++i)
    for (std::size_t j = i + 2; j < segments; ++j) {
      if (closed && i == 0 && j + 1 == segments) continue;
      if (meet(points[i], points[i + 1], points[j], points[(j + 1) % n]))
        throw Error(fmt::format("the line crosses itself: its pieces {} and {} meet near ({}, {})", i + 1,
                                j + 1, points[j].x(), points[j].y()));
    }
}

}  // namespace

SurfaceMesh polyline(std::vector<Eigen::Vector2d> points, bool closed, const std::string& place) {
  if (closed && points.size() > 1 && points.front() == points.back()) points.pop_back();
  const std::size_t least = closed ? 3 : 2, n = points.size();
  try {
    if (n < least) throw Error(fmt::format("found {} points; allowed: at least {}", n, least));
    requireSimple(points, closed);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", place, error.what()));
  }
  double area = 0.0;
  for (std::size_t i = 0; i < n; ++i) area += cross(points[i], points[(i + 1) % n]);
  if (closed && area < 0.0) std::reverse(points.begin(), points.end());
  SurfaceMesh line;
  line.closed = closed;
  line.points = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(n));
  for (std::size_t i = 0; i < n; ++i) line.points.col(static_cast<Eigen::Index>(i)).head<2>() = points[i];
  line.cells.resize(2, line.points.cols() - (closed ? 0 : 1));
  for (Eigen::Index c = 0; c < line.cells.cols(); ++c) {
    line.cells(0, c) = static_cast<int>(c);
    line.cells(1, c) = static_cast<int>((c + 1) % line.points.cols());
  }
  return line;
}

SurfaceMesh readPolyline(const std::filesystem::path& file, bool closed) {
  requireFile(file, "polyline");
  std::ifstream in(file);
  if (!in) throw Error(fmt::format("{}: cannot be read", file.string()));
  std::vector<Eigen::Vector2d> points;
  int number = 0;
  for (std::string text; std::getline(in, text);) {
    ++number;
    std::istringstream line(text);
    if (std::string first; !(line >> first) || first.front() == '#') continue;
    line = std::istringstream(text);
    Eigen::Vector2d point;
    std::string rest;
    if (!(line >> point.x() >> point.y()) || !point.allFinite() || line >> rest)
      throw Error(
          fmt::format("{}:{}: found '{}'; allowed: two numbers, x and y", file.string(), number, text));
    points.push_back(point);
  }
  return polyline(std::move(points), closed, file.string());
}

}  // namespace burnish
