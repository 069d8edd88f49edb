#pragma once
#include <array>
#include <optional>

#include "engine/nurbs/patch.h"
#include "engine/rezoning/rezoning_options.h"
#include "engine/rezoning/span_distribution.h"

namespace burnish::inline rezoning {

struct RemeshOptions {
  FaceId face = 3;             ///< along which the knot spans are distributed
  ArcInterval finest;          ///< of its arc length in the deformed patch
  std::array<int, 2> spans{};  ///< per direction of the patch
  double rounding = 0.0;       ///< of the growth of spans, see `SpanGrowth`
  NewMeshOptions mesh{};
};

/// A new mesh of a deformed patch.
struct Remeshing {
  Patch<2> patch;
  double boundaryError = 0.0;  ///< largest distance of the boundaries along their normals
  double quality = 0.0;        ///< smallest over largest determinant of the map
  double smallestSpan = 0.0;   ///< length of the smallest span along the face
};

/// Meshes a deformed patch anew: functions of the same family and degree, its parameters shares of arc length
/// along the boundaries, weights of one. Inside by transfinite interpolation if that makes a sound mesh, else
/// by a reparametrisation of the patch, relaxed like an elastic sheet. Nothing if no sound mesh was found.
std::optional<Remeshing> remesh(const Patch<2>& deformed, const RemeshOptions& options);

/// Smallest over largest determinant of the map at the quadrature points of all spans.
double meshQuality(const Patch<2>& patch);

}  // namespace burnish::inline rezoning
