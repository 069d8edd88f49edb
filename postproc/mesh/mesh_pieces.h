#pragma once
#include <cstddef>
#include <vector>

#include "engine/results/result.h"

namespace burnish {

/// A slab of a patch: some neighbouring knot spans of one direction, and all spans of the others.
struct MeshPiece {
  std::size_t patch = 0;
  std::size_t direction = 0;
  int firstSpan = 0;
  int numSpans = 0;
};

/// All patches of a mesh in about `count` pieces of about as many spans each: slabs across the direction of most
/// spans, one at least of every patch, and no more than it has layers.
std::vector<MeshPiece> piecesOf(const MeshRecord& mesh, int count);

}  // namespace burnish
