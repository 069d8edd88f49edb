#pragma once
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace burnish {

/// The polygons of a surface, those of more than three corners as triangles about the mean of their corners, which has
/// the means of the point data, its normals of unit length: a mirror image has the image of them, and a quadrilateral no
/// diagonal. A polygon that is not seen whole from there stays as it is. Cell data are those of the polygons.
vtkSmartPointer<vtkPolyData> trianglesAboutMiddles(vtkPolyData& surface);

}  // namespace burnish
