#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>

#include "engine/results/result.h"

class vtkPolyData;

namespace burnish {

/// Points (3 x n) that should be seen so that one understands where a tool is, given the box of the body: the
/// corners of the box of what is finite, or the foot of the body's centre on a plane.
Eigen::Matrix3Xd toolLandmarks(const ToolRecord& tool, const Eigen::AlignedBox3d& body);

/// What is drawn of a tool; either part may be null.
struct ToolDrawing {
  vtkSmartPointer<vtkPolyData> surface;
  vtkSmartPointer<vtkPolyData> lines;
  bool hidesBody = false;  ///< the surface stands between eye and body and must be drawn transparent
};

/// In 2D a filled disc with its outline, or a line with hatches on the side of the tool; in 3D a surface.
/// visible: the box that is seen; stroke: length of a hatch.
ToolDrawing drawTool(const ToolRecord& tool, int dim, const Eigen::AlignedBox3d& visible, double stroke);

}  // namespace burnish
