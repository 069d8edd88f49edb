#include "postproc/mesh/mesh_pieces.h"

#include <algorithm>
#include <cmath>

#include "postproc/mesh/patch_geometry.h"

namespace burnish {

std::vector<MeshPiece> piecesOf(const MeshRecord& mesh, int count) {
  std::vector<std::vector<int>> spans;  // of every patch and direction
  std::vector<double> sizes;
  double total = 0.0;
  for (const PatchRecord& patch : mesh.patches) {
    auto& ofPatch = spans.emplace_back();
    sizes.push_back(1.0);
    for (const DirectionRecord& direction : patch.directions) {
      ofPatch.push_back(basisOf(direction).numSpans());
      sizes.back() *= ofPatch.back();
    }
    total += sizes.back();
  }

  std::vector<MeshPiece> pieces;
  for (std::size_t patch = 0; patch < spans.size(); ++patch) {
    const auto longest = std::max_element(spans[patch].begin(), spans[patch].end());
    const auto direction = static_cast<std::size_t>(longest - spans[patch].begin());
    const int wanted = static_cast<int>(std::lround(count * sizes[patch] / total));
    const int number = std::clamp(wanted, 1, *longest);
    for (int k = 0; k < number; ++k) {
      const int first = k * *longest / number, end = (k + 1) * *longest / number;
      pieces.push_back({patch, direction, first, end - first});
    }
  }
  return pieces;
}

}  // namespace burnish
