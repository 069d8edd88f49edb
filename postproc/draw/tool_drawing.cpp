#include "postproc/draw/tool_drawing.h"

#include <vtkCellArray.h>
#include <vtkPolyData.h>

#include <cmath>
#include <variant>

#include "postproc/mesh/outlines.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

struct Landmarks {
  const Eigen::AlignedBox3d& body;

  Eigen::Matrix3Xd operator()(const Plane& plane) const {
    const Eigen::Vector3d n = plane.normal.normalized();
    const double height = (body.center() - plane.origin).dot(n);
    constexpr double hatchRoom = 0.04;
    Eigen::Matrix3Xd points(3, 2);
    points.col(0) = body.center() - height * n;
    points.col(1) = points.col(0) - hatchRoom * body.diagonal().norm() * n;
    return points;
  }
  Eigen::Matrix3Xd operator()(const Cylinder& cylinder) const {
    return corners(cylinder.center, cylinder.radius);
  }
  Eigen::Matrix3Xd operator()(const Sphere& sphere) const { return corners(sphere.center, sphere.radius); }

  Eigen::Matrix3Xd operator()(const SurfaceMesh& mesh) const {
    return corners(Eigen::AlignedBox3d(mesh.points.rowwise().minCoeff(), mesh.points.rowwise().maxCoeff()));
  }

  Eigen::Matrix3Xd corners(const Eigen::Vector3d& center, double radius) const {
    const Eigen::Vector3d r = Eigen::Vector3d::Constant(radius);
    return corners(Eigen::AlignedBox3d(center - r, center + r));
  }
  Eigen::Matrix3Xd corners(const Eigen::AlignedBox3d& box) const {
    Eigen::Matrix3Xd points(3, 8);
    for (int k = 0; k < 8; ++k) points.col(k) = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k));
    return points;
  }
};

/// A segment with slanted strokes on the side opposite to `normal`.
vtkSmartPointer<vtkPolyData> hatchedSegment(const Eigen::Vector3d& begin, const Eigen::Vector3d& end,
                                            const Eigen::Vector3d& normal, double stroke) {
  const Eigen::Vector3d along = (end - begin).normalized();
  const Eigen::Vector3d slant = stroke * (-normal.normalized() - along).normalized();
  const int strokes = static_cast<int>((end - begin).norm() / (0.6 * stroke));
  Eigen::Matrix3Xd points(3, 2 * (strokes + 1));
  points.leftCols<2>() << begin, end;
  for (int k = 1; k <= strokes; ++k) {
    points.col(2 * k) = begin + 0.6 * stroke * k * along;
    points.col(2 * k + 1) = points.col(2 * k) + slant;
  }
  vtkNew<vtkCellArray> lines;
  for (vtkIdType k = 0; k <= strokes; ++k) lines->InsertNextCell({2 * k, 2 * k + 1});
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(makePoints(points));
  data->SetLines(lines);
  return data;
}

vtkSmartPointer<vtkPolyData> filled(vtkPolyData& outline) {
  vtkNew<vtkCellArray> polygon;
  polygon->InsertNextCell(static_cast<int>(outline.GetNumberOfPoints()));
  for (vtkIdType k = 0; k < outline.GetNumberOfPoints(); ++k) polygon->InsertCellPoint(k);
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(outline.GetPoints());
  data->SetPolys(polygon);
  return data;
}

}  // namespace

Eigen::Matrix3Xd toolLandmarks(const ToolRecord& tool, const Eigen::AlignedBox3d& body) {
  return std::visit(Landmarks{body}, tool.shape);
}

ToolDrawing drawTool(const ToolRecord& tool, int dim, const Eigen::AlignedBox3d& visible, double stroke) {
  const auto outline = toolOutline(tool, dim, visible);
  const Plane* plane = std::get_if<Plane>(&tool.shape);
  if (dim == 3) return {outline, nullptr, plane != nullptr};
  if (plane)
    return {nullptr, hatchedSegment(Eigen::Vector3d(outline->GetPoint(0)),
                                    Eigen::Vector3d(outline->GetPoint(1)), plane->normal, stroke)};
  const auto* mesh = std::get_if<SurfaceMesh>(&tool.shape);
  if (mesh && !mesh->closed) return {nullptr, outline};
  return {filled(*outline), outline};
}

}  // namespace burnish
