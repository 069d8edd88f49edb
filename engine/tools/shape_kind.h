#pragma once

namespace burnish::inline tools {

/// Bodies that a shape is for.
enum class ForBodies { All, Planar, Spatial, SpatialOrAxisymmetric };

/// What a shape's key `file` means: there is none, a file that is read with the shape, a control net whose
/// keys take the place of its name when the scene is read.
enum class ShapeFile { None, Read, ControlNet };

/// What a scene says about a shape: the value of its key `shape`, a sentence, the bodies that it is for.
struct ShapeKind {
  const char* key;
  const char* sentence;
  ForBodies bodies = ForBodies::All;
  ShapeFile file = ShapeFile::None;
};

}  // namespace burnish::inline tools
