#pragma once
#include <vtkSmartPointer.h>

#include "postproc/mesh/frame_parts.h"

namespace burnish {

/// The faces of `contactSurface` to their edges, beyond their outermost quadrature points: what is added there has
/// the values of the nearest of these. For pictures; the points of the solver are the others alone.
vtkSmartPointer<vtkPolyData> contactSurfaceToEdges(const ModelRecord& model, const FrameRecord& frame,
                                                   const ContactName& contact);

}  // namespace burnish
