#pragma once
#include <cstddef>
#include <vector>

#include "engine/results/result.h"

namespace burnish {

/// A patch where some of its parameters have their first or last value: a face, an edge; or all of it.
struct PatchSide {
  enum class End { Begin, End, None };

  std::size_t patch = 0;
  std::vector<End> ends;  ///< per direction
};

/// The functions of a patch that do not vanish on a side, in its order, first direction fastest.
std::vector<int> functionsOn(const PatchRecord& patch, const PatchSide& side);

/// The nodes of a side in the order of the patch, first direction fastest.
std::vector<int> nodesOn(const MeshRecord& mesh, const PatchSide& side);

/// Which edges of the patches are edges of the body. Sides that have the same nodes are one: faces that two
/// patches share lie inside the body, and so do the two ends of a patch that is closed to a ring.
class PatchBorders {
 public:
  explicit PatchBorders(const MeshRecord& mesh);

  /// The edges of the body, each once: where two free faces of a patch meet, or those of two patches around
  /// others; in 2D the free faces.
  const std::vector<PatchSide>& outline() const { return outline_; }

  /// The edges, each once, at which patches go over into each other; in 3D those on the surface.
  const std::vector<PatchSide>& seams() const { return seams_; }

  /// The edges that several patches have, or one patch several times: those in one place.
  const std::vector<std::vector<PatchSide>>& sharedEdges() const { return sharedEdges_; }

  /// What can be seen of the body: in 2D the patches, in 3D the free faces.
  const std::vector<PatchSide>& surface() const { return surface_; }

 private:
  std::vector<PatchSide> outline_, seams_, surface_;
  std::vector<std::vector<PatchSide>> sharedEdges_;
};

}  // namespace burnish
