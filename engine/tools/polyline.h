#pragma once
#include <Eigen/Dense>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/tools/faceted_shape.h"
#include "engine/tools/shape_kind.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

class ShapeProblems;

/// Line through points, the tool to its left; a closed line is turned counterclockwise. `place` names the
/// line in messages. Throws `Error` if points coincide or the line crosses itself.
SurfaceMesh polyline(std::vector<Eigen::Vector2d> points, bool closed, const std::string& place);

/// Line through the points of a text file, x and y in every line; empty lines and those that begin with # are
/// passed over. Throws `Error` like `polyline`, and for a line that is not two numbers.
SurfaceMesh readPolyline(const std::filesystem::path& file, bool closed);

/// A line as a scene gives it.
struct PolylineTool {
  static constexpr ShapeKind kind{"polyline", "A line through points, in two dimensions.", ForBodies::Planar,
                                  ShapeFile::Read};

  std::string file;  ///< absolute when the scene has been read
  std::vector<std::vector<double>> points;
  bool closed = true;
  std::optional<double> smoothing;

  FacetedShape made() const;
};

template <class Visitor>
void describe(Visitor& v, PolylineTool& s) {
  v.field("file", s.file, {},
          "Text file with x and y of a point in every line, beside the scene; instead of points.");
  v.field("points", s.points, {.minEntries = 2, .unit = "length"}, "Coordinates of the points.");
  v.field("closed", s.closed, {},
          "Whether the last point is joined to the first. The tool is inside a closed line, to the left of "
          "an open one.");
  v.field("smoothing", s.smoothing, {.above = 0, .unit = "length"}, kSmoothingSentence);
}

void check(const PolylineTool& line, const ShapeProblems& problems);

}  // namespace burnish::inline tools
