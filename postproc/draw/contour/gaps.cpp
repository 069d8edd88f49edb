#include "postproc/draw/contour/gaps.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <array>
#include <cmath>

#include "postproc/draw/contour/contour_parts.h"

namespace burnish {
namespace {

/// Lines or polygons with values at all corners, and the others.
std::array<vtkSmartPointer<vtkCellArray>, 2> cellsByValue(vtkCellArray& cells, vtkDataArray& values) {
  std::array parts{vtkSmartPointer<vtkCellArray>::New(), vtkSmartPointer<vtkCellArray>::New()};
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < cells.GetNumberOfCells(); ++cell) {
    cells.GetCellAtId(cell, corners);
    std::size_t part = 0;
    for (const vtkIdType corner : *corners)
      if (!std::isfinite(values.GetComponent(corner, 0))) part = 1;
    parts[part]->InsertNextCell(corners);
  }
  return parts;
}

bool hasGapsIn(const vtkSmartPointer<vtkPolyData>& part) {
  return part != nullptr && partsByValue(*part).without != nullptr;
}

}  // namespace

PartsByValue partsByValue(vtkPolyData& part) {
  vtkDataArray* values = part.GetPointData()->GetScalars();
  bool areFinite = true;
  for (vtkIdType k = 0; values && areFinite && k < values->GetNumberOfTuples(); ++k)
    areFinite = std::isfinite(values->GetComponent(k, 0));
  if (areFinite) return {&part, nullptr};
  const auto lines = cellsByValue(*part.GetLines(), *values), polys = cellsByValue(*part.GetPolys(), *values);
  PartsByValue parts;
  for (const std::size_t k : {0U, 1U}) {
    auto& some = k == 0 ? parts.with : parts.without;
    some = vtkSmartPointer<vtkPolyData>::New();
    some->SetPoints(part.GetPoints());
    some->GetPointData()->ShallowCopy(part.GetPointData());
    some->SetLines(lines[k]);
    some->SetPolys(polys[k]);
  }
  if (parts.without->GetNumberOfCells() == 0) parts.without = nullptr;
  return parts;
}

bool hasGaps(const ContourParts& parts) {
  return hasGapsIn(parts.body) || hasGapsIn(parts.section);
}

}  // namespace burnish
