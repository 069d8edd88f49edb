#pragma once
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <Eigen/Dense>
#include <vector>

#include "postproc/mesh/picture_planes.h"

/// Cells of other programs as pictures need them. What is drawn is an array `drawn` of points or of cells.
namespace burnish {

/// How often the faces of curved cells are halved along each parameter.
inline constexpr int kCurvedParts = 3;

/// The cells of several grids that can be seen: volumes, and faces that are no faces of these, nor parts of straight ones. Points at the same
/// place are one, so that what is inside is found, but for those of two grids whose values differ; where values differ
/// within a grid, as between discontinuous elements, the place has the first one.
vtkSmartPointer<vtkUnstructuredGrid> shownCells(
    const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& grids);

/// The image in a plane, also of the point data `vectors` and `stress` (xx, yy, zz, xy, yz, zx), which arrows show: at points on
/// the plane they lose what changes its sign there, in the cells as well. sign: what becomes of the values that are drawn.
vtkSmartPointer<vtkUnstructuredGrid> mirroredCells(vtkUnstructuredGrid& cells, const MirrorPlane& plane,
                                                   double sign);

/// Whether all faces lie in a plane of constant z and there is no volume.
bool isPlane(vtkUnstructuredGrid& cells);

/// The faces that are seen from outside, with the numbers of their cells; curved ones in parts. Those of volumes look away
/// from them.
vtkSmartPointer<vtkPolyData> outerFaces(vtkUnstructuredGrid& cells);

/// The polygons of faces with `drawn` as point scalars: those of cells have points of their own, with one value.
vtkSmartPointer<vtkPolyData> withDrawnScalars(vtkPolyData& faces);

/// The edges of cells that are seen on the outer faces; of linear parts those of the curved cells.
vtkSmartPointer<vtkPolyData> cellEdges(vtkPolyData& faces);

}  // namespace burnish
