#include "engine/tools/surface_file.h"

#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Projection_traits_3.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/lower_case.h"
#include "engine/core/stl_counts.h"
#include "engine/tools/polygon_soup.h"

namespace burnish::inline tools {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Point = SoupPoint;
using Polygons = SoupPolygons;
using Mesh = CGAL::Surface_mesh<Point>;
using Face = Mesh::Face_index;

/// Number of places that an error names.
constexpr std::size_t kNamed = 3;

/// So many pairs of triangles that intersect are enough: in a heap of loose ones every pair may.
constexpr unsigned kMostCrossings = 10'000;

/// "3 triangles without area, at (0, 0, 1), ...".
std::string countedAt(std::size_t count, const char* noun, const char* rest,
                      const std::vector<Point>& places) {
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < std::min(places.size(), kNamed); ++k)
    texts.push_back(fmt::format("({:.6g}, {:.6g}, {:.6g})", places[k].x(), places[k].y(), places[k].z()));
  return fmt::format("{} {}{}{}, at {}{}", count, noun, count == 1 ? "" : "s", rest, fmt::join(texts, ", "),
                     count > texts.size() ? ", ..." : "");
}

std::vector<Point> cornersOf(const Mesh& mesh, Face face) {
  std::vector<Point> corners;
  for (const auto v : mesh.vertices_around_face(mesh.halfedge(face))) corners.push_back(mesh.point(v));
  return corners;
}

Point middleOf(const Mesh& mesh, Face face) {
  const auto corners = cornersOf(mesh, face);
  return CGAL::centroid(corners.begin(), corners.end());
}

std::vector<Point> middlesOf(const Mesh& mesh, const std::vector<Face>& faces) {
  std::vector<Point> places;
  for (const Face face : faces) places.push_back(middleOf(mesh, face));
  return places;
}

std::vector<Point> rimOf(const Mesh& mesh) {
  std::vector<Point> places;
  for (const auto h : mesh.halfedges())
    if (mesh.is_border(h))
      places.push_back(CGAL::midpoint(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))));
  return places;
}

/// Points that differ by rounding alone become the same point.
void snap(std::vector<Point>& points) {
  constexpr double kRounding = 1e-8;
  const auto box = CGAL::bbox_3(points.begin(), points.end());
  const double tolerance =
      kRounding * std::max({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()});
  if (tolerance == 0.0) return;
  using Cell = std::array<std::int64_t, 3>;
  std::map<Cell, Point> known;
  for (Point& p : points) {
    Cell at{};
    for (int d = 0; d < 3; ++d)
      at[static_cast<std::size_t>(d)] = static_cast<std::int64_t>(std::floor(p[d] / (2.0 * tolerance)));
    bool isNew = true;
    for (int k = 0; k < 27 && isNew; ++k) {
      const auto near = known.find({at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1});
      isNew = near == known.end() || CGAL::squared_distance(near->second, p) > tolerance * tolerance;
      if (!isNew) p = near->second;
    }
    if (isNew) known.emplace(at, p);
  }
}

/// Throws unless all corners are points with usable coordinates.
void requireUsable(const std::vector<Point>& points, const Polygons& polygons) {
  constexpr double kLargest = 1e100;
  for (const Point& p : points)
    for (int d = 0; d < 3; ++d)
      if (!(std::abs(p[d]) < kLargest)) throw Error("found a coordinate that is no number or beyond 1e100");
  for (const auto& polygon : polygons)
    if (polygon.size() < 3 || std::ranges::any_of(polygon, [&](std::size_t k) { return k >= points.size(); }))
      throw Error("found a polygon of less than three points, or with a point that does not exist");
}

/// Throws if the corners of a face lie on one line, so that it has no normal, or come back to one of its
/// points; such ones make no mesh.
void requireAreas(const std::vector<Point>& points, const Polygons& polygons) {
  std::size_t first = 0;
  std::vector<Point> places;
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    const auto& corners = polygons[k];
    const auto at = [&](std::size_t i) { return points[corners[i]]; };
    bool isFlat = true;
    for (std::size_t i = 2; i < corners.size(); ++i)
      isFlat = isFlat && CGAL::collinear(at(0), at(i - 1), at(i));
    auto sorted = corners;
    std::ranges::sort(sorted);
    if (!isFlat && std::ranges::adjacent_find(sorted) == sorted.end()) continue;
    if (places.empty()) first = k + 1;
    std::vector<Point> own;
    for (std::size_t i = 0; i < corners.size(); ++i) own.push_back(at(i));
    places.push_back(CGAL::centroid(own.begin(), own.end()));
  }
  if (!places.empty())
    throw Error(countedAt(places.size(), "face", " without area", places) +
                fmt::format(", the first is number {}; their corners coincide or lie on one line: remove "
                            "them, or repair the mesh where it was made",
                            first));
}

/// A mesh without coincident points, its faces oriented alike.
Mesh meshOf(std::vector<Point> points, Polygons polygons) {
  snap(points);
  pmp::merge_duplicate_points_in_polygon_soup(points, polygons);
  requireAreas(points, polygons);
  pmp::merge_duplicate_polygons_in_polygon_soup(points, polygons);
  pmp::remove_isolated_points_in_polygon_soup(points, polygons);
  const std::size_t known = points.size();
  if (!pmp::orient_polygon_soup(points, polygons))
    throw Error(countedAt(points.size() - known, "non-manifold point", "",
                          {points.begin() + static_cast<std::ptrdiff_t>(known), points.end()}) +
                "; allowed: at most two faces at an edge, and one fan of faces around a point");
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  return mesh;
}

/// Whether no edges of a polygon cross, seen along its normal.
bool isSimple(const Mesh& mesh, Face face) {
  const auto normal = pmp::compute_face_normal(face, mesh);
  if (normal == CGAL::NULL_VECTOR) return false;
  const auto corners = cornersOf(mesh, face);
  return CGAL::is_simple_2(corners.begin(), corners.end(),
                           CGAL::Projection_traits_3<CGAL::Kernel_traits<Point>::Kernel>(normal));
}

/// Cuts polygons into triangles; throws if the edges of one cross, of which the cut would leave a mesh that
/// is none.
void requireTriangles(Mesh& mesh) {
  std::vector<Face> crossed;
  for (const Face face : mesh.faces())
    if (!CGAL::is_triangle(mesh.halfedge(face), mesh) && !isSimple(mesh, face)) crossed.push_back(face);
  if (!crossed.empty())
    throw Error(countedAt(crossed.size(), "polygon", " whose edges cross", middlesOf(mesh, crossed)) +
                "; allowed: polygons that can be cut into triangles");
  pmp::triangulate_faces(mesh);
}

void requireSound(const Mesh& mesh, bool open) {
  std::vector<Face> degenerate;
  for (const Face face : mesh.faces())
    if (pmp::is_degenerate_triangle_face(face, mesh)) degenerate.push_back(face);
  if (!degenerate.empty())
    throw Error(countedAt(degenerate.size(), "triangle", " without area", middlesOf(mesh, degenerate)));
  if (const auto rim = rimOf(mesh); !rim.empty() && !open)
    throw Error(countedAt(rim.size(), "edge", " on a rim", rim) +
                "; allowed: a closed surface, or open: true for a tool behind its triangles");
  std::vector<std::pair<Face, Face>> crossings;
  pmp::self_intersections(mesh, std::back_inserter(crossings),
                          CGAL::parameters::maximum_number(kMostCrossings));
  if (crossings.empty()) return;
  std::vector<Face> first;
  for (const auto& [one, other] : crossings) first.push_back(one);
  throw Error((crossings.size() < kMostCrossings ? "" : "at least ") +
              countedAt(crossings.size(), "pair", " of triangles that intersect", middlesOf(mesh, first)));
}

SurfaceMesh exported(const Mesh& mesh) {
  SurfaceMesh surface;
  surface.closed = CGAL::is_closed(mesh);
  surface.points.resize(3, static_cast<Eigen::Index>(mesh.number_of_vertices()));
  surface.cells.resize(3, static_cast<Eigen::Index>(mesh.number_of_faces()));
  for (const auto v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    surface.points.col(static_cast<Eigen::Index>(v.idx())) << p.x(), p.y(), p.z();
  }
  for (const Face face : mesh.faces()) {
    Eigen::Index k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(face)))
      surface.cells(k++, static_cast<Eigen::Index>(face.idx())) = static_cast<int>(v.idx());
  }
  return surface;
}

SurfaceMesh surfaceOf(std::vector<Point> points, Polygons polygons, bool open) {
  if (polygons.empty()) throw Error("found faces without area, of which no triangles can be made");
  requireUsable(points, polygons);
  Mesh mesh = meshOf(std::move(points), std::move(polygons));
  requireTriangles(mesh);
  requireSound(mesh, open);
  if (CGAL::is_closed(mesh)) pmp::orient_to_bound_a_volume(mesh);
  mesh.collect_garbage();
  return exported(mesh);
}

}  // namespace

void requireFile(const std::filesystem::path& file, const char* kind) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw Error(fmt::format("{}: this is a directory; allowed: the file of a {}", file.string(), kind));
  if (!std::filesystem::exists(file, ignored))
    throw Error(fmt::format("{}: there is no such file", file.string()));
  if (!std::filesystem::is_regular_file(file, ignored))
    throw Error(fmt::format("{}: this is no regular file; allowed: the file of a {}", file.string(), kind));
}

SurfaceMesh readSurface(const std::filesystem::path& file, double scale, bool open) {
  requireFile(file, "mesh");
  try {
    std::vector<Point> points;
    Polygons polygons;
    if (inLowerCase(file.extension().string()) == ".stl")
      if (const std::string damage = stlDamage(file); !damage.empty()) throw Error(damage);
    if (!readPolygonSoup(file, points, polygons) || polygons.empty())
      throw Error("found no surface; allowed: STL, OBJ, PLY or OFF files of triangles or polygons");
    for (Point& p : points) p = Point(scale * p.x(), scale * p.y(), scale * p.z());
    return surfaceOf(std::move(points), std::move(polygons), open);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

SurfaceMesh soundSurface(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& cells, bool open) {
  std::vector<Point> corners;
  for (const auto& p : points.colwise()) corners.emplace_back(p.x(), p.y(), p.z());
  Polygons triangles;
  for (const auto& cell : cells.colwise())
    triangles.push_back({static_cast<std::size_t>(cell(0)), static_cast<std::size_t>(cell(1)),
                         static_cast<std::size_t>(cell(2))});
  return surfaceOf(std::move(corners), std::move(triangles), open);
}

}  // namespace burnish::inline tools
