#pragma once
#include <string>
#include <vector>

#include "engine/cad/cad_file.h"
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

/// The same for CAD, by bodies: the patches of plane bodies, in z = 0; in space the faces of the bodies, without those at which patches
/// are joined and those that collapse to a line or a point. Their names are BODY.PATCH.FACE, with the number of the patch from
/// 1. Throws `Error` if frame and model disagree.
std::vector<CadBody> nurbsBodies(const ModelRecord& model, const FrameRecord& frame);

}  // namespace burnish
