#include "postproc/mesh/poly_builder.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace burnish {

PolyBuilder::PolyBuilder()
    : points_(vtkSmartPointer<vtkPoints>::New()),
      lines_(vtkSmartPointer<vtkCellArray>::New()),
      polygons_(vtkSmartPointer<vtkCellArray>::New()) {
  points_->SetDataType(VTK_DOUBLE);
}

PolyBuilder::~PolyBuilder() = default;

std::vector<vtkIdType> PolyBuilder::addPoints(const Eigen::MatrixXd& positions) {
  std::vector<vtkIdType> ids;
  for (const auto& x : positions.colwise())
    ids.push_back(points_->InsertNextPoint(x(0), x(1), x.size() > 2 ? x(2) : 0.0));
  return ids;
}

void PolyBuilder::addLine(const std::vector<vtkIdType>& points) {
  lines_->InsertNextCell(static_cast<vtkIdType>(points.size()), points.data());
}

void PolyBuilder::addPolygon(const std::vector<vtkIdType>& points) {
  polygons_->InsertNextCell(static_cast<vtkIdType>(points.size()), points.data());
}

vtkSmartPointer<vtkPolyData> PolyBuilder::finish() const {
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points_);
  if (lines_->GetNumberOfCells() > 0) data->SetLines(lines_);
  if (polygons_->GetNumberOfCells() > 0) data->SetPolys(polygons_);
  return data;
}

}  // namespace burnish
