#pragma once
#include <string>

#include "engine/results/result.h"
#include "engine/solid/face_place.h"

namespace burnish {

/// A face as a person names it.
struct FaceAddress {
  std::string face;   ///< left, right, bottom, top, back, front
  std::string patch;  ///< as the scene names it; may be empty in a body of one patch
};

/// The face of the one body that a frame shows. Throws `Error` that
/// lists the bodies, patches or faces if there are several bodies or no such patch or face.
FacePlace facePlace(const ModelRecord& model, const FrameRecord& frame, const FaceAddress& address);

}  // namespace burnish
