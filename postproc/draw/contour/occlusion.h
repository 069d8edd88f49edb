#pragma once
#include <vtkSmartPointer.h>

#include <vector>

#include "postproc/draw/contour/contour_parts.h"
#include "postproc/draw/contour/tool_drawing.h"

namespace burnish {

/// Gives the surfaces in space that have normals the point data `kSky`: rays as long as a quarter of the bodies.
/// Tools stop rays as far as one cannot see through them.
void setSky(const ContourParts& parts, const std::vector<ToolDrawing>& tools, double toolOpacity);

/// The shadow of the bodies on the ground on which they stand, a surface of RGBA points. Null where the eye does not
/// look down on it or a tool is in its place. y goes up.
vtkSmartPointer<vtkPolyData> groundShadow(const ContourParts& parts, const std::vector<ToolDrawing>& tools,
                                          double toolOpacity);

}  // namespace burnish
