#pragma once
#include <vtkIdList.h>
#include <vtkUnstructuredGrid.h>

namespace burnish {

/// Adds a cell of one grid to another one, without its data, and returns its number there. pointOf: the number of a
/// point of the first one in the second. ids: memory for them, which many cells can share.
template <class PointOf>
vtkIdType copyCell(vtkUnstructuredGrid& from, vtkIdType cell, vtkUnstructuredGrid& to, vtkIdList& ids,
                   const PointOf& pointOf) {
  if (from.GetCellType(cell) != VTK_POLYHEDRON) {
    from.GetCellPoints(cell, &ids);
    for (vtkIdType& id : ids) id = pointOf(id);
    return to.InsertNextCell(from.GetCellType(cell), &ids);
  }
  from.GetFaceStream(cell, &ids);
  vtkIdType at = 1;
  for (vtkIdType face = 0; face < ids.GetId(0); ++face)
    for (vtkIdType last = at + ids.GetId(at) + 1; ++at < last;) ids.SetId(at, pointOf(ids.GetId(at)));
  return to.InsertNextCell(VTK_POLYHEDRON, &ids);
}

}  // namespace burnish
