#include "postproc/draw/foreign/foreign_percentiles.h"

#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace burnish {
namespace {

/// Of a simplex with so many corners.
double simplexSize(vtkPoints& points, vtkIdType first, int corners) {
  constexpr std::array kFactorials{1.0, 1.0, 2.0, 6.0};
  Eigen::Matrix3d edges = Eigen::Matrix3d::Zero();
  const Eigen::Vector3d from = Eigen::Map<const Eigen::Vector3d>(points.GetPoint(first));
  for (int k = 1; k < corners; ++k)
    edges.col(k - 1) = Eigen::Map<const Eigen::Vector3d>(points.GetPoint(first + k)) - from;
  const auto used = edges.leftCols(corners - 1);
  const double gram = (used.transpose() * used).determinant();
  return std::sqrt(std::max(0.0, gram)) / kFactorials[static_cast<std::size_t>(corners - 1)];
}

}  // namespace

Eigen::VectorXd sizesIn(vtkPointSet& places, bool ofCells) {
  Eigen::VectorXd sizes =
      Eigen::VectorXd::Zero(ofCells ? places.GetNumberOfCells() : places.GetNumberOfPoints());
  vtkNew<vtkGenericCell> cell;
  int highest = 0;
  for (vtkIdType k = 0; k < places.GetNumberOfCells(); ++k) {
    cell->SetCellType(places.GetCellType(k));
    highest = std::max(highest, cell->GetCellDimension());
  }
  vtkNew<vtkIdList> ids;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType k = 0; k < places.GetNumberOfCells(); ++k) {
    places.GetCell(k, cell);
    if (cell->GetCellDimension() != highest) continue;
    cell->Triangulate(0, ids, points);
    const int corners = highest + 1;
    for (vtkIdType first = 0; first + corners <= ids->GetNumberOfIds(); first += corners) {
      const double size = simplexSize(*points, first, corners);
      if (ofCells) {
        sizes(k) += size;
        continue;
      }
      for (int corner = 0; corner < corners; ++corner) sizes(ids->GetId(first + corner)) += size / corners;
    }
  }
  return sizes;
}

}  // namespace burnish
