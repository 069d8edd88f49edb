#include "postproc/draw/contour_parts.h"

#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include "postproc/draw/color_range.h"
#include "postproc/draw/contour_view.h"
#include "postproc/draw/field_choice.h"
#include "postproc/draw/tool_drawing.h"
#include "postproc/mesh/body_surface.h"
#include "postproc/mesh/frame_parts.h"
#include "postproc/mesh/outlines.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

/// Longest arrow as a part of the diagonal of what is seen of the body.
constexpr double kArrowLength = 0.07;

/// A tool is shown whole if it reaches no further than this beyond the body (part of the body's diagonal),
/// else cut off at the smaller distance.
constexpr double kToolReach = 0.4, kToolCut = 0.2;

constexpr double kDotRoom = 0.005;  // for the dots of the control net, of the diagonal

vtkSmartPointer<vtkPolyData> makeBody(const ModelRecord& model, const FrameRecord& frame,
                                      const ContourOptions& options) {
  const BodySurface surface(model, subdivisionOf(model, options));
  const auto body = surface.displaced(options.warp * frame.displacement);
  const Eigen::MatrixXd values = surface.evaluate(chooseField(model, frame, options.field).coefficients);
  body->GetPointData()->SetScalars(makeArray("drawn", drawnScalars(values).transpose(), {}));
  if (options.arrows == ArrowField::Displacement)
    body->GetPointData()->AddArray(
        makeArray("displacement", inSpace(surface.evaluate(frame.displacement)), kAxes));
  return body;
}

/// Parts of what is seen, so that it is the same for a body and for a part of it.
double arrowLength(vtkPolyData& body, const ViewAxes& axes, const ContourOptions& options) {
  Eigen::AlignedBox2d box = boxOf(body, axes);
  if (options.window && options.window->intersects(box)) box = options.window->intersection(box);
  return kArrowLength * box.diagonal().norm();
}

Eigen::AlignedBox2d grown(const Eigen::AlignedBox2d& box, double part) {
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(part * box.diagonal().norm());
  return {box.min() - margin, box.max() + margin};
}

}  // namespace

int subdivisionOf(const ModelRecord& model, const ContourOptions& options) {
  return options.subdivision.value_or(model.subdivision);
}

ContourParts contourParts(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options) {
  const int subdivision = subdivisionOf(model, options);
  ContourParts parts;
  parts.axes = options.axes.value_or(viewNamed("auto", model.dim));
  parts.displacement = options.warp * frame.displacement;
  if (options.tools)
    for (std::size_t k = 0; k < model.tools.size(); ++k)
      parts.tools.push_back(placedTool(model, frame, k, options.warp));
  parts.body = makeBody(model, frame, options);
  parts.outline = bodyOutline(model, parts.displacement, subdivision);
  if (options.undeformed) parts.undeformed = bodyOutline(model, {}, subdivision);
  if (options.controlNet) {
    FrameRecord shape;
    shape.displacement = parts.displacement;
    parts.net = controlNet(model, shape);
  }
  if (options.arrows != ArrowField::None)
    parts.arrows = contourArrows(options.arrows, model, frame, *parts.body, parts.axes,
                                 arrowLength(*parts.body, parts.axes, options));
  return parts;
}

Eigen::AlignedBox3d boxOf(vtkPolyData& part) {
  const double* b = part.GetBounds();
  return {Eigen::Vector3d(b[0], b[2], b[4]), Eigen::Vector3d(b[1], b[3], b[5])};
}

Eigen::AlignedBox2d boxOf(vtkPolyData& part, const ViewAxes& axes) {
  if (part.GetNumberOfPoints() == 0) return {};
  const Eigen::Map<const Eigen::Matrix3Xd> x(static_cast<const double*>(part.GetPoints()->GetVoidPointer(0)),
                                             3, part.GetNumberOfPoints());
  const Eigen::Matrix2Xd projected = axes * x;
  return {projected.rowwise().minCoeff(), projected.rowwise().maxCoeff()};
}

Eigen::AlignedBox2d contentOf(const ContourParts& parts) {
  Eigen::AlignedBox2d box = boxOf(*parts.body, parts.axes);
  if (parts.undeformed) box.extend(boxOf(*parts.undeformed, parts.axes));
  if (parts.net) box = grown(box.merged(boxOf(*parts.net, parts.axes)), kDotRoom);
  if (parts.arrows.edges) box.extend(boxOf(*parts.arrows.edges, parts.axes));
  const Eigen::AlignedBox2d near = grown(box, kToolReach), cut = grown(box, kToolCut);
  for (const ToolRecord& record : parts.tools) {
    const Eigen::Matrix2Xd landmarks = parts.axes * toolLandmarks(record, boxOf(*parts.body));
    const Eigen::AlignedBox2d tool(landmarks.rowwise().minCoeff(), landmarks.rowwise().maxCoeff());
    const Eigen::AlignedBox2d& seen = near.contains(tool) ? near : cut;
    if (seen.intersects(tool)) box.extend(seen.intersection(tool));
  }
  return box;
}

}  // namespace burnish
