#pragma once
#include <vtkSmartPointer.h>

#include <optional>
#include <string>

#include "engine/results/result.h"
#include "postproc/mesh/curved_cells.h"
#include "postproc/mesh/span_points.h"

class vtkUnstructuredGrid;

namespace burnish {

/// The lines between the knot spans of every patch and its edges, of a volume those on its faces, on the current
/// positions, with the point data of `setPoints`. points: those of the body's cells, through which the lines
/// go. family: that of curved cells, of which a line has one per knot span; without one a line is one polyline.
/// Throws `Error` if a field does not fit the mesh.
vtkSmartPointer<vtkUnstructuredGrid> makeSpanLines(const SpanPoints& points,
                                                   std::optional<CurvedFamily> family,
                                                   const FrameRecord& frame, const std::string& lengthUnit);

}  // namespace burnish
