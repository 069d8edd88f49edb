#include "postproc/mesh/middle_triangles.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <Eigen/Dense>
#include <vector>

namespace burnish {
namespace {

/// Whether the triangles of a mean with the sides of its polygon go round the same way. corners: as columns.
bool isSeenWhole(const Eigen::Matrix3Xd& corners, const Eigen::Vector3d& mean) {
  Eigen::Matrix3Xd across(3, corners.cols());
  for (Eigen::Index k = 0; k < corners.cols(); ++k)
    across.col(k) = Eigen::Vector3d(corners.col(k) - mean)
                        .cross(Eigen::Vector3d(corners.col((k + 1) % corners.cols()) - mean));
  return ((across.rowwise().sum().transpose() * across).array() > 0.0).all();
}

}  // namespace

vtkSmartPointer<vtkPolyData> trianglesAboutMiddles(vtkPolyData& surface) {
  if (surface.GetNumberOfPolys() == 0 || surface.GetPolys()->GetMaxCellSize() <= 3) return &surface;
  const auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->DeepCopy(surface.GetPoints());
  vtkPointData &data = *result->GetPointData(), &before = *surface.GetPointData();
  data.InterpolateAllocate(&before, surface.GetNumberOfPoints() + surface.GetNumberOfPolys());
  for (vtkIdType k = 0; k < surface.GetNumberOfPoints(); ++k) data.CopyData(&before, k, k);
  vtkCellData& cellData = *result->GetCellData();
  cellData.CopyAllocate(surface.GetCellData());
  const vtkIdType others = surface.GetNumberOfVerts() + surface.GetNumberOfLines();
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkIdList> ids;
  const auto add = [&](vtkIdType polygon, std::initializer_list<vtkIdType> corners) {
    cellData.CopyData(surface.GetCellData(), others + polygon, triangles->InsertNextCell(corners));
  };
  for (vtkIdType polygon = 0; polygon < surface.GetNumberOfPolys(); ++polygon) {
    surface.GetPolys()->GetCellAtId(polygon, ids);
    const vtkIdType count = ids->GetNumberOfIds();
    Eigen::Matrix3Xd corners(3, count);
    for (vtkIdType k = 0; k < count; ++k) points->GetPoint(ids->GetId(k), corners.col(k).data());
    const Eigen::Vector3d mean = corners.rowwise().mean();
    if (count <= 3 || !isSeenWhole(corners, mean)) {
      cellData.CopyData(surface.GetCellData(), others + polygon, triangles->InsertNextCell(ids));
      continue;
    }
    const vtkIdType middle = points->InsertNextPoint(mean.data());
    std::vector<double> shares(static_cast<std::size_t>(count), 1.0 / static_cast<double>(count));
    data.InterpolatePoint(&before, middle, ids, shares.data());
    if (vtkDataArray* normals = data.GetNormals()) {
      const Eigen::Vector3d normal = Eigen::Vector3d(normals->GetTuple3(middle)).normalized();
      normals->SetTuple(middle, normal.data());
    }
    for (vtkIdType k = 0; k < count; ++k) add(polygon, {ids->GetId(k), ids->GetId((k + 1) % count), middle});
  }
  result->SetPoints(points);
  result->SetPolys(triangles);
  return result;
}

}  // namespace burnish
