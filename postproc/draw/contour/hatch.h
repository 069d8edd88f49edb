#pragma once
#include <vtkSmartPointer.h>

#include "postproc/draw/page/view.h"

class vtkPolyData;

namespace burnish {

/// Lines over a flat section that rise to the right in the picture, at these distances in pixels, as sections are
/// drawn in engineering.
vtkSmartPointer<vtkPolyData> hatchOf(vtkPolyData& section, const View& view, double pixels);

}  // namespace burnish
