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
vtkSmartPointer<vtkPolyData> bodyOutline(const ModelRecord& model, const Eigen::MatrixXd& displacement,
                                         int subdivision);

/// The lines between knot spans and between patches, without those of `bodyOutline`; of a volume, those on
/// its surface.
vtkSmartPointer<vtkPolyData> knotLines(const ModelRecord& model, const Eigen::MatrixXd& displacement,
                                       int subdivision);

/// A tool moved by `displacement` (2 or 3 components). In 2D one polyline: a plane is a segment that passes
/// the whole of `box`, a cylinder or a sphere a closed circle whose points in their order are also its
/// polygon. In 3D polygons, planes and cylinders cut off outside the box.
vtkSmartPointer<vtkPolyData> toolOutline(const ToolRecord& tool, const Eigen::VectorXd& displacement,
                                         const Eigen::AlignedBox3d& box);

}  // namespace burnish
