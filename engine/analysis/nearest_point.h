#pragma once
#include "engine/solid/body.h"
#include "engine/solid/face_place.h"
#include "engine/tools/tool.h"

namespace burnish::inline analysis {

/// Gaps smaller than this share of a length count as touching.
inline constexpr double kTouching = 1e-9;

/// Where an undeformed face comes nearest to a tool.
struct NearestPoint {
  double gap = 0.0;     ///< smallest point-wise gap
  double facing = 0.0;  ///< outward normal of the face times the tool's normal: -1 where they face each other
};

/// Nearest point of the undeformed face and the tool where its motion has it at time t, found by sampling and
/// zooming in.
template <int Dim>
NearestPoint nearestPoint(const Body<Dim>& body, const FacePlace& place, const Tool& tool, double t);

}  // namespace burnish::inline analysis
