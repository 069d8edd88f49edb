#include "postproc/draw/page/flat_shapes.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>

#include <numeric>

namespace burnish {
namespace {

/// One cell that has all points, or cells of `size` points each.
vtkNew<vtkCellArray> cellsOf(const FlatShapes::Points& points, std::size_t size) {
  vtkNew<vtkCellArray> cells;
  std::vector<vtkIdType> corners(size);
  for (std::size_t first = 0; first + size <= points.size(); first += size) {
    std::iota(corners.begin(), corners.end(), static_cast<vtkIdType>(first));
    cells->InsertNextCell(static_cast<vtkIdType>(size), corners.data());
  }
  return cells;
}

}  // namespace

void FlatShapes::addConvexPolygon(const Points& corners, const Color& color) {
  vtkNew<vtkPolyData> shape;
  shape->SetPolys(cellsOf(corners, corners.size()));
  add(*shape, corners, 1.0, color);
}

void FlatShapes::addPolyline(const Points& points, double width, const Color& color) {
  vtkNew<vtkPolyData> shape;
  shape->SetLines(cellsOf(points, points.size()));
  add(*shape, points, width, color);
}

void FlatShapes::addSegments(const Points& points, double width, const Color& color) {
  vtkNew<vtkPolyData> shape;
  shape->SetLines(cellsOf(points, 2));
  add(*shape, points, width, color);
}

void FlatShapes::add(vtkPolyData& shape, const Points& points, double width, const Color& color) {
  vtkNew<vtkPoints> positions;
  for (const Eigen::Vector2d& p : points) positions->InsertNextPoint(scale_ * p.x(), scale_ * p.y(), 0.0);
  shape.SetPoints(positions);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(&shape);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetLineWidth(static_cast<float>(scale_ * width));
  actor->GetProperty()->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
  renderer_.AddActor2D(actor);
}

}  // namespace burnish
