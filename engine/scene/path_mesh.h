#pragma once
#include <cstddef>
#include <vector>

#include "engine/scene/scene.h"

namespace burnish::inline scene {

/// Knot spans that suit all passes of a tool on its path, after `ResolutionSpec`. With the half width a of the contact
/// and n spans per width, so of the length h = 2a/n, they are
///
///     along the face   of the length h from 2a before the passes to 2a behind them, then growing by the factor of the
///                      resolution from one to the next,
///     into the depth   h/2 at the face, and growing alike.
///
/// The last ones are fitted to the box. With rezoning in space, the first of `followingMeshes`. Fills in
/// `ResolutionSpec::breaks` of all bodies for which that is possible; for others `requirePathMesh` says why not.
void resolveMeshes(Scene& scene);

/// Whether the mesh of a body in space follows the tool of its resolution.
bool hasFollowingMeshes(const Scene& scene, std::size_t body);

/// A mesh that is fine around a part of the passes.
struct FollowingMesh {
  /// Time from which on it is used: when the tool is about to leave the part of the one before.
  double from = 0.0;

  std::vector<std::vector<double>> breaks;  ///< see `ResolutionSpec`
};

/// The meshes of a body that follow its tool, in order, the first one from the start on. Each has fine spans around a
/// part of the passes that is nowhere longer than the `travel` of the rezoning, twice the width of the contact when that
/// is left out. Between two passes meshes change while the tool is in the air. Throws as `requirePathMesh`.
std::vector<FollowingMesh> followingMeshes(const Scene& scene, std::size_t body);

/// The scene with other spans of a body's resolution.
Scene withBreaks(Scene scene, std::size_t body, const std::vector<std::vector<double>>& breaks);

/// Throws `InputError`, with the key of the resolution, for a body whose mesh cannot be made.
void requirePathMesh(const Scene& scene, std::size_t body);

/// How far a box should reach beyond the passes, and how deep, so that its ends do not matter, over the half width of
/// the contact.
inline constexpr double kRoomBeside = 5.0, kRoomBelow = 6.0;

/// How far the box of a resolution reaches, over the half width of the contact.
struct PathRoom {
  double beside = 0.0;  ///< from the passes to the nearest end
  double below = 0.0;
};
PathRoom pathRoom(const Scene& scene, std::size_t body);

}  // namespace burnish::inline scene
