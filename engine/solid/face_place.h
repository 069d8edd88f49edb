#pragma once
#include "engine/nurbs/patch.h"

namespace burnish::inline solid {

/// A face of a body: of which patch, and which of its faces.
struct FacePlace {
  int patch = 0;
  FaceId face = 0;

  bool operator==(const FacePlace&) const = default;
};

}  // namespace burnish::inline solid
