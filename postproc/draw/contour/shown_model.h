#pragma once
#include "postproc/draw/contour/picture_options.h"
#include "postproc/mesh/chosen_bodies.h"
#include "postproc/mesh/mirror.h"

namespace burnish {

/// Calls `act` with the model and the frame that are drawn: with their images in mirrors, where components of a
/// field may have another sign, and of the chosen bodies alone.
template <class Act>
auto withShownModel(const ModelRecord& model, const FrameRecord& frame, const PictureOptions& options,
                    const Act& act) {
  if (options.mirror.empty() && options.bodies.empty()) return act(model, frame);
  ModelFrame shown{model, frame};
  if (!options.mirror.empty()) shown = mirrored(shown.model, shown.frame, options.mirror);
  if (!options.bodies.empty()) shown = chosenBodies(shown.model, shown.frame, options.bodies);
  return act(shown.model, shown.frame);
}

}  // namespace burnish
