#pragma once
#include <optional>
#include <string>

#include "engine/core/length_unit.h"
#include "engine/tools/faceted_shape.h"
#include "engine/tools/rigid_shape.h"
#include "engine/tools/shape_kind.h"

namespace burnish::inline tools {

class ShapeProblems;

/// A face, a shell, a solid or all of a CAD file as a scene gives it: an exact NURBS surface if it is a single face without trimming
/// curves, else triangles.
struct CadTool {
  static constexpr ShapeKind kind{"cad", "A face, a shell, a solid or all of a STEP or IGES file (3D).",
                                  ForBodies::Spatial, ShapeFile::Read};

  std::string file;  ///< absolute when the scene has been read
  std::string face;
  std::string shell;
  std::string solid;
  LengthUnit unit = LengthUnit::Millimetre;
  double scale = 1.0;
  std::optional<double> tolerance;  ///< of the triangles
  bool open = false;
  std::optional<double> smoothing;

  /// Throws `Error` if the file cannot be read or does not hold such a surface.
  RigidShape made() const;
};

template <class Visitor>
void describe(Visitor& v, CadTool& s) {
  v.field("file", s.file, {.required = true},
          "CAD file, beside the scene: STEP (.step, .stp) or IGES (.iges, .igs).");
  v.field(
      "face", s.face, {},
      "Name of a face, or its number from 1 in the order of the file. One that is not trimmed is an exact NURBS "
      "surface; the tool is behind it.");
  v.field("shell", s.shell, {},
          "Name of a shell, faces that hang together, or its number from 1; solids have shells, too.");
  v.field(
      "solid", s.solid, {},
      "Name of a solid, or its number from 1. Without face, shell and solid the tool is all of the file.");
  v.field(
      "unit", s.unit, {},
      "Unit of the scene's lengths, that of units unless it is said here: those of the file, which says its own "
      "unit, are converted into it.");
  v.field("scale", s.scale, {.above = 0},
          "Further factor on the coordinates, for a file that names a wrong unit.");
  v.field(
      "tolerance", s.tolerance, {.above = 0, .unit = "length"},
      "How far the triangles that stand for trimmed faces, or for several, may be from them; a 1000th of the "
      "largest extent when left out.");
  v.field(
      "open", s.open, {},
      "Whether a surface of triangles may have a rim; the tool is then behind its faces. An exact face always may.");
  v.field("smoothing", s.smoothing, {.above = 0, .unit = "length"}, kSmoothingSentence);
}

void check(const CadTool& tool, const ShapeProblems& problems);

}  // namespace burnish::inline tools
