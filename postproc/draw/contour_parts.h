#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>

#include "engine/results/result.h"
#include "postproc/draw/contour.h"
#include "postproc/draw/contour_arrows.h"
#include "postproc/draw/view.h"

class vtkPolyData;

namespace burnish {

/// What a contour picture shows in space, where it stands in the frame: displacements times the warp.
struct ContourParts {
  ViewAxes axes;
  Eigen::MatrixXd displacement;       ///< of the body, dim x nodes
  std::vector<ToolRecord> tools;      ///< those that are shown, where they stand
  vtkSmartPointer<vtkPolyData> body;  ///< its point scalars are the values that are drawn
  vtkSmartPointer<vtkPolyData> outline;
  vtkSmartPointer<vtkPolyData> undeformed, net;  ///< null where they are not shown
  ContourArrows arrows;
};

/// Throws `Error` for an unknown field or view.
ContourParts contourParts(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options);

/// Cells per knot span and direction.
int subdivisionOf(const ModelRecord& model, const ContourOptions& options);

/// The smallest box round a part in space, and in the picture's plane.
Eigen::AlignedBox3d boxOf(vtkPolyData& part);
Eigen::AlignedBox2d boxOf(vtkPolyData& part, const ViewAxes& axes);

/// The projected box that is to be seen.
Eigen::AlignedBox2d contentOf(const ContourParts& parts);

}  // namespace burnish
