#include "engine/tools/polyline.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "engine/core/error.h"
#include "engine/tools/line_crossing.h"
#include "engine/tools/shape_problems.h"
#include "engine/tools/surface_file.h"

namespace burnish::inline tools {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

void requireSimple(const std::vector<Eigen::Vector2d>& points, bool closed) {
  const std::size_t n = points.size(), segments = closed ? n : n - 1;
  for (std::size_t i = 0; i < segments; ++i)
    if (points[i] == points[(i + 1) % n])
      throw Error(fmt::format("points {} and {} are both ({}, {})", i + 1, (i + 1) % n + 1, points[i].x(),
                              points[i].y()));
  if (const auto crossing = findLineCrossing(points, closed)) {
    const auto [i, j] = *crossing;
    throw Error(fmt::format("the line crosses itself: its pieces {} and {} meet near ({}, {})", i + 1, j + 1,
                            points[j].x(), points[j].y()));
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

FacetedShape PolylineTool::made() const {
  if (!file.empty()) return makeFacetedShape(readPolyline(file, closed), smoothing);
  std::vector<Eigen::Vector2d> corners;
  for (const auto& point : points) corners.emplace_back(point[0], point[1]);
  return makeFacetedShape(polyline(std::move(corners), closed, "points"), smoothing);
}

void check(const PolylineTool& line, const ShapeProblems& problems) {
  if (!problems.clean("file") || !problems.clean("points")) return;
  if (line.file.empty() == line.points.empty())
    problems.report(fmt::format("found {}; allowed: exactly one of points and file.",
                                line.file.empty() ? "neither points nor file" : "points and file"));
  if (problems.dim() == 2) problems.requireDimension("points", line.points, 2);
  if (line.closed && !line.points.empty() && line.points.size() < 3)
    problems.report(
        "points", fmt::format("found {} points of a closed line; allowed: at least 3.", line.points.size()));
}

}  // namespace burnish::inline tools
