#include "postproc/view/view_tools.h"

#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>

#include <optional>

#include "postproc/draw/contour/shape_lines.h"
#include "postproc/draw/contour/tool_drawing.h"
#include "postproc/mesh/recorded_shape.h"
#include "postproc/view/view_mesh.h"

namespace burnish {
namespace {

/// Length of a hatch as a part of the diagonal of the box.
constexpr double kStroke = 0.004;

Json::Value vectorJson(const Eigen::Vector3d& vector) {
  Json::Value json = Json::arrayValue;
  for (const double x : vector) json.append(x);
  return json;
}

}  // namespace

Json::Value partJson(vtkPolyData* part, const Eigen::Vector3d& origin) {
  if (part == nullptr || part->GetNumberOfPoints() == 0) return Json::nullValue;
  vtkNew<vtkTriangleFilter> filter;
  filter->SetInputData(part);
  filter->PassVertsOff();
  filter->Update();
  vtkPolyData& simple = *filter->GetOutput();
  Eigen::MatrixXd points(3, simple.GetNumberOfPoints());
  for (vtkIdType k = 0; k < points.cols(); ++k) points.col(k) = Eigen::Vector3d(simple.GetPoint(k)) - origin;
  std::vector<int> triangles, segments;
  vtkNew<vtkIdList> cell;
  for (vtkIdType k = 0; k < simple.GetNumberOfCells(); ++k) {
    simple.GetCellPoints(k, cell);
    if (cell->GetNumberOfIds() == 3 && simple.GetNumberOfPolys() > 0)
      for (vtkIdType i = 0; i < 3; ++i) triangles.push_back(static_cast<int>(cell->GetId(i)));
    else
      for (vtkIdType i = 0; i + 1 < cell->GetNumberOfIds(); ++i)
        for (vtkIdType j = i; j < i + 2; ++j) segments.push_back(static_cast<int>(cell->GetId(j)));
  }
  Json::Value json;
  json["points"] = floatsText(points);
  if (!triangles.empty()) json["triangles"] = integersText(triangles);
  if (!segments.empty()) json["segments"] = integersText(segments);
  if (vtkDataArray* normals = simple.GetPointData()->GetNormals()) {
    Eigen::MatrixXd n(3, points.cols());
    for (vtkIdType k = 0; k < n.cols(); ++k) n.col(k) = Eigen::Vector3d(normals->GetTuple3(k));
    json["normals"] = floatsText(n);
  }
  if (vtkDataArray* values = simple.GetPointData()->GetScalars()) {
    Eigen::MatrixXd row(1, points.cols());
    for (vtkIdType k = 0; k < row.cols(); ++k) row(k) = values->GetTuple1(k);
    json["values"] = floatsText(row);
  }
  return json;
}

Json::Value viewTools(const std::vector<ToolRecord>& tools, int dim, const Eigen::AlignedBox3d& box,
                      const Eigen::Vector3d& origin, bool turns) {
  Json::Value list = Json::arrayValue;
  for (const ToolRecord& tool : tools) {
    Json::Value json;
    json["name"] = tool.name;
    json["pivot"] = vectorJson(tool.pivot - origin);
    json["axis"] = vectorJson(tool.axis.normalized());
    if (dim == 2) {
      const ToolDrawing drawing = drawPlaneTool(tool, box, kStroke * box.diagonal().norm(),
                                                turns ? std::optional(0.0) : std::nullopt);
      json["area"] = partJson(drawing.area, origin);
      json["lines"] = partJson(drawing.lines, origin);
    } else {
      const auto shape = withoutSeams(*toolOutline(tool, 3, box));
      json["area"] = partJson(withNormals(*shape), origin);
      json["lines"] = partJson(edgesOf(*shape), origin);
      json["isClosed"] = hasInside(tool.shape);
    }
    list.append(json);
  }
  return list;
}

Eigen::MatrixXd toolMotion(const ModelRecord& model, const FrameRecord& frame, double warp) {
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(4, static_cast<Eigen::Index>(model.tools.size()));
  if (motion.cols() == 0) return motion;
  motion.topRows(frame.toolDisplacement.rows()) = warp * frame.toolDisplacement;
  if (frame.toolAngle.size() > 0) motion.row(3) = warp * frame.toolAngle.transpose();
  return motion;
}

}  // namespace burnish
