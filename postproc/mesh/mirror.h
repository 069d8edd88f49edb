#pragma once
#include <string>
#include <vector>

#include "postproc/mesh/model_frame.h"
#include "postproc/mesh/picture_planes.h"

namespace burnish {

/// What a mirror across an axis makes of a component (x, xy, ...; empty for scalars and lengths) of a field: 1 or -1.
double signInMirror(const std::string& component, int axis);

/// The whole body of which the model computes the part on one side of these planes: patches, fields, tools
/// and contact tractions with their images, one plane after the other. Patches share the nodes on a plane; a
/// tool that is its own image, at rest and in its place, stays one; names of tools are those of the model.
/// Values at quadrature points of the volume are left out. Throws `Error` for an axis that the model does not
/// have and a plane that is none of symmetry: through the body, beside it (but for the axis of an
/// axisymmetric body), or left by it.
ModelFrame mirrored(const ModelRecord& model, const FrameRecord& frame,
                    const std::vector<MirrorPlane>& planes);

}  // namespace burnish
