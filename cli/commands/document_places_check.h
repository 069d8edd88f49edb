#pragma once
#include "engine/results/result.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/scene/scene_document.h"

namespace burnish {

/// Throws `Error` with places in the scene's file if the planes of its pictures are none of symmetry or miss
/// the undeformed body, or if the places of its probes are none of the body.
void requirePlaces(const SceneDocument& document, const ModelRecord& model);

}  // namespace burnish
