#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>

#include "postproc/mesh/picture_subdivision.h"
#include "postproc/mesh/plane_section.h"

class vtkPolyData;
class vtkUnstructuredGrid;

/// Sections of bodies in space whose points are exact.
namespace burnish {

/// Gives the points of a `Tessellation` their parameters in their patches, from which exact ones are found.
void addParameters(vtkUnstructuredGrid& cells, const MeshRecord& mesh, int subdivision);

/// The section of cells with `addParameters`: triangles that do not share points.
vtkSmartPointer<vtkPolyData> sectionOfCells(vtkUnstructuredGrid& cells, const CutPlane& plane);

/// Triangles and what is at their points.
struct SectionTriangles {
  vtkSmartPointer<vtkPolyData> surface;
  Eigen::MatrixXd values;  ///< components x points; none without values
};

/// A section of the body (displacement: 3 x nodes) from one of straight cells, `sectionOfCells`: its points lie where
/// the plane cuts the body, and have the values of the field there. Triangles in sight are cut until the border is
/// within the tolerance, and values are at the middles of their edges, but into no more than `kMostPartsOfEdge` parts of
/// an edge.
inline constexpr int kMostPartsOfEdge = 8;
SectionTriangles exactSection(const MeshRecord& mesh, const Eigen::MatrixXd& displacement,
                              const CutPlane& plane, vtkPolyData& ofCells, const PositionTolerance& positions,
                              const ValueTolerance* values);

}  // namespace burnish
