#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/results/result.h"
#include "postproc/draw/page/view.h"
#include "postproc/mesh/plane_section.h"

class vtkPolyData;

namespace burnish {

/// What is drawn of a tool; each part may be null.
struct ToolDrawing {
  vtkSmartPointer<vtkPolyData> area;     ///< flat: the tool in the plane, or in a section
  vtkSmartPointer<vtkPolyData> surface;  ///< in space, with normals
  vtkSmartPointer<vtkPolyData> lines;
};

/// In the plane: what is closed as an area with its outline, else a line with hatches on the side of the
/// tool. visible: the box that is seen; stroke: length of a hatch; turn: of a disc, which then has a radius
/// that shows it, in radians; error: as of `toolOutline`.
ToolDrawing drawPlaneTool(const ToolRecord& tool, const Eigen::AlignedBox3d& visible, double stroke,
                          std::optional<double> turn = {}, double error = HUGE_VAL);

/// Where areas of tools are cut off at the border of what is seen of a view: thin lines along it, each with a zigzag of
/// this height, which says that the tool goes on. In pixels.
std::vector<std::vector<Eigen::Vector2d>> breakLines(const std::vector<ToolDrawing>& tools, const View& view,
                                                     double zigzag);

/// In space: the surface, its edges and where it turns away from the eye. With `cut` only what lies behind
/// it, and the section.
ToolDrawing drawSpaceTool(const ToolRecord& tool, const Eigen::AlignedBox3d& visible, const View& view,
                          double error, const std::optional<CutPlane>& cut = {});

/// The section of a tool in space, drawn as one in the plane.
ToolDrawing drawToolSection(const ToolRecord& tool, const Eigen::AlignedBox3d& visible, const CutPlane& plane,
                            double stroke, double error);

}  // namespace burnish
