#pragma once
#include <string>

#include "engine/results/result.h"

namespace burnish {

/// Files of other programs that hold NURBS.
enum class NurbsFormat {
  G2,   ///< of GoTools: surfaces (200) or volumes (700), one after the other
  Json  ///< as geomdl (NURBS-Python) writes and reads it, with the body's name and the time
};

/// The patches of a frame on the current positions, exactly. Those of Lagrange elements are written as B-splines with
/// multiple knots. Throws `Error` if frame and model disagree.
std::string nurbsText(const ModelRecord& model, const FrameRecord& frame, NurbsFormat format);

}  // namespace burnish
