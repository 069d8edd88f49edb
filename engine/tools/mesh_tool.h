#pragma once
#include <optional>
#include <string>

#include "engine/tools/faceted_shape.h"
#include "engine/tools/shape_kind.h"

namespace burnish::inline tools {

/// A triangulated surface as a scene gives it.
struct MeshTool {
  static constexpr ShapeKind kind{"mesh", "A triangulated surface (3D).", ForBodies::Spatial,
                                  ShapeFile::Read};

  std::string file;  ///< absolute when the scene has been read
  double scale = 1.0;
  bool open = false;
  std::optional<double> smoothing;

  /// Throws `Error` if the file cannot be read or does not hold a surface.
  FacetedShape made() const;
};

template <class Visitor>
void describe(Visitor& v, MeshTool& s) {
  v.field("file", s.file, {.required = true},
          "Triangulated surface, beside the scene: STL, OBJ, PLY or OFF.");
  v.field("scale", s.scale, {.above = 0}, "Factor on the coordinates of the file.");
  v.field("open", s.open, {},
          "Whether the surface may have a rim; the tool is then behind its triangles, whose corners go "
          "counterclockwise seen from the front.");
  v.field("smoothing", s.smoothing, {.above = 0, .unit = "length"}, kSmoothingSentence);
}

}  // namespace burnish::inline tools
