#pragma once
#include <vtkSmartPointer.h>

#include "postproc/mesh/picture_planes.h"

class vtkDataSet;
class vtkPolyData;

namespace burnish {

/// Whether cells of a section that meet have their points in common, and so one value of point data there.
enum class SectionPoints { Shared, OfEachCell };

/// Where a plane cuts cells, with the point data there: triangles of volumes, segments of surfaces, points of
/// lines. What lies in the plane itself is not cut.
vtkSmartPointer<vtkPolyData> sectionOf(vtkDataSet& cells, const CutPlane& plane,
                                       SectionPoints points = SectionPoints::Shared);

/// The part of polygons and lines to which the normal does not point, with its point data.
vtkSmartPointer<vtkPolyData> behind(vtkPolyData& parts, const CutPlane& plane);

/// The areas that segments enclose in their common plane, in any order: a loop inside another one that goes
/// round the other way is a hole. Without cells where no loop is closed.
vtkSmartPointer<vtkPolyData> enclosedAreas(vtkPolyData& segments);

/// All cells in one data set, with the point data that all of them have.
vtkSmartPointer<vtkPolyData> together(vtkPolyData& one, vtkPolyData& other);

}  // namespace burnish
