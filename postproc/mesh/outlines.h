#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include "engine/results/result.h"

class vtkPolyData;

namespace burnish {

/// The edges of the body (of a single patch the 4 of a surface or the 12 of a volume; not those at which it
/// is joined to others, see `PatchBorders`) as polylines with `subdivision` segments per knot span.
/// displacement: dim x nodes; empty for the undeformed body.
vtkSmartPointer<vtkPolyData> bodyOutline(const MeshRecord& mesh, const Eigen::MatrixXd& displacement,
                                         int subdivision);

/// The lines between knot spans and between patches, without those of `bodyOutline`; of a volume, those on
/// its surface.
vtkSmartPointer<vtkPolyData> knotLines(const MeshRecord& mesh, const Eigen::MatrixXd& displacement,
                                       int subdivision);

/// A shape moved by a rigid motion or mirrored; the tool stays on its side of the cells of a mesh.
RecordedShape mappedShape(const RecordedShape& shape, const Eigen::Affine3d& map);

/// A tool that is turned about its axis, then displaced.
ToolRecord movedTool(const ToolRecord& tool, const Eigen::Vector3d& displacement, double angle);

/// A tool as it stands in a frame, its motion scaled by `warp`: turned and displaced.
ToolRecord placedTool(const ModelRecord& model, const FrameRecord& frame, std::size_t tool,
                      double warp = 1.0);

/// The parts of the segments of a plane shape that lie in a box, whose depth does not count.
SurfaceMesh segmentsIn(const SurfaceMesh& mesh, const Eigen::AlignedBox3d& box);

/// The surface of a tool. In 2D one polyline: a plane is a segment that passes the whole of `box`, a cylinder
/// or a sphere a closed circle whose points in their order are also its polygon; of other shapes segments.
/// In 3D polygons, planes and cylinders cut off a little outside the box.
vtkSmartPointer<vtkPolyData> toolOutline(const ToolRecord& tool, int dim, const Eigen::AlignedBox3d& box);

}  // namespace burnish
