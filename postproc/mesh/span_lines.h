#pragma once
#include <vtkSmartPointer.h>

#include <string>

#include "engine/results/result.h"
#include "postproc/mesh/span_points.h"

class vtkUnstructuredGrid;

namespace burnish {

/// How lines are written.
enum class LineCells {
  Polylines,  ///< one for each line
  Bezier      ///< a curve for each knot span, exactly as computed
};

/// The lines between the knot spans of every patch and its edges, of a volume those on its faces, on the current
/// positions, with the point data of `setPoints`. points: of the body, through which polylines go, or the
/// coefficients of curves. Throws `Error` if a field does not fit the mesh.
vtkSmartPointer<vtkUnstructuredGrid> makeSpanLines(const SpanPoints& points, LineCells cells,
                                                   const FrameRecord& frame, const std::string& lengthUnit);

}  // namespace burnish
