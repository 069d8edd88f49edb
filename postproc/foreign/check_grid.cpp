#include "postproc/foreign/check_grid.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkIdTypeArray.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <map>

namespace burnish {
namespace {

/// Types of cells with so many points.
const std::map<int, vtkIdType>& fixedSizes() {
  static const std::map<int, vtkIdType> sizes{{VTK_EMPTY_CELL, 0},
                                              {VTK_VERTEX, 1},
                                              {VTK_LINE, 2},
                                              {VTK_TRIANGLE, 3},
                                              {VTK_PIXEL, 4},
                                              {VTK_QUAD, 4},
                                              {VTK_TETRA, 4},
                                              {VTK_VOXEL, 8},
                                              {VTK_HEXAHEDRON, 8},
                                              {VTK_WEDGE, 6},
                                              {VTK_PYRAMID, 5},
                                              {VTK_PENTAGONAL_PRISM, 10},
                                              {VTK_HEXAGONAL_PRISM, 12},
                                              {VTK_QUADRATIC_EDGE, 3},
                                              {VTK_QUADRATIC_TRIANGLE, 6},
                                              {VTK_QUADRATIC_QUAD, 8},
                                              {VTK_QUADRATIC_TETRA, 10},
                                              {VTK_QUADRATIC_HEXAHEDRON, 20},
                                              {VTK_QUADRATIC_WEDGE, 15},
                                              {VTK_QUADRATIC_PYRAMID, 13},
                                              {VTK_BIQUADRATIC_QUAD, 9},
                                              {VTK_TRIQUADRATIC_HEXAHEDRON, 27},
                                              {VTK_QUADRATIC_LINEAR_QUAD, 6},
                                              {VTK_QUADRATIC_LINEAR_WEDGE, 12},
                                              {VTK_BIQUADRATIC_QUADRATIC_WEDGE, 18},
                                              {VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, 24},
                                              {VTK_BIQUADRATIC_TRIANGLE, 7},
                                              {VTK_CUBIC_LINE, 4}};
  return sizes;
}

/// Types of cells with so many points or more.
const std::map<int, vtkIdType>& leastSizes() {
  static const std::map<int, vtkIdType> sizes{{VTK_POLY_VERTEX, 1},    {VTK_POLY_LINE, 2},
                                              {VTK_TRIANGLE_STRIP, 3}, {VTK_POLYGON, 3},
                                              {VTK_LAGRANGE_CURVE, 2}, {VTK_BEZIER_CURVE, 2}};
  return sizes;
}

/// Points of a curved cell of these degrees; 0 for a type that is not curved.
vtkIdType curvedSize(int type, const std::array<vtkIdType, 3>& p) {
  switch (type) {
    case VTK_LAGRANGE_CURVE:
    case VTK_BEZIER_CURVE:
      return p[0] + 1;
    case VTK_LAGRANGE_TRIANGLE:
    case VTK_BEZIER_TRIANGLE:
      return (p[0] + 1) * (p[0] + 2) / 2;
    case VTK_LAGRANGE_QUADRILATERAL:
    case VTK_BEZIER_QUADRILATERAL:
      return (p[0] + 1) * (p[1] + 1);
    case VTK_LAGRANGE_TETRAHEDRON:
    case VTK_BEZIER_TETRAHEDRON:
      return (p[0] + 1) * (p[0] + 2) * (p[0] + 3) / 6;
    case VTK_LAGRANGE_HEXAHEDRON:
    case VTK_BEZIER_HEXAHEDRON:
      return (p[0] + 1) * (p[1] + 1) * (p[2] + 1);
    case VTK_LAGRANGE_WEDGE:
    case VTK_BEZIER_WEDGE:
      return (p[0] + 1) * (p[0] + 2) / 2 * (p[2] + 1);
    default:
      return 0;
  }
}

/// Cells whose degrees nothing says have the same in all directions.
bool hasEqualDegrees(int type, vtkIdType size) {
  constexpr vtkIdType kHighestDegree = 10;  // of VTK
  for (vtkIdType p = 1; p <= kHighestDegree; ++p)
    if (curvedSize(type, {p, p, p}) == size) return true;
  return false;
}

bool hasItsSize(int type, vtkIdType size, vtkDataArray* degrees, vtkIdType cell) {
  if (const auto found = fixedSizes().find(type); found != fixedSizes().end()) return found->second == size;
  if (curvedSize(type, {1, 1, 1}) > 0) {
    if (degrees == nullptr) return hasEqualDegrees(type, size);
    std::array<vtkIdType, 3> p{};
    for (int d = 0; d < 3; ++d) {
      const double degree = degrees->GetComponent(cell, d);
      if (!(degree >= 1.0 && degree <= 10.0)) return false;
      p[static_cast<std::size_t>(d)] = static_cast<vtkIdType>(degree);
    }
    return curvedSize(type, p) == size;
  }
  const auto least = leastSizes().find(type);
  return least != leastSizes().end() && size >= least->second;
}

/// Offsets rise from 0 to the end, and there are the points.
bool areCells(vtkCellArray* cells, vtkIdType numPoints) {
  if (cells == nullptr) return true;
  vtkDataArray &offsets = *cells->GetOffsetsArray(), &points = *cells->GetConnectivityArray();
  if (offsets.GetNumberOfComponents() != 1 || points.GetNumberOfComponents() != 1) return false;
  double before = 0.0;
  for (vtkIdType k = 0; k < offsets.GetNumberOfTuples(); ++k) {
    const double offset = offsets.GetComponent(k, 0);
    if (offset < before || (k == 0 && offset != 0.0)) return false;
    before = offset;
  }
  if (before != static_cast<double>(points.GetNumberOfTuples())) return false;
  for (vtkIdType k = 0; k < points.GetNumberOfTuples(); ++k) {
    const double point = points.GetComponent(k, 0);
    if (point < 0.0 || point >= static_cast<double>(numPoints)) return false;
  }
  return true;
}

bool haveAtLeast(vtkCellArray* cells, vtkIdType least) {
  for (vtkIdType k = 0; cells != nullptr && k < cells->GetNumberOfCells(); ++k)
    if (cells->GetCellSize(k) < least) return false;
  return true;
}

/// Of a polyhedron: the number of faces, then of each face the number of its points and these.
bool isPolyhedron(vtkIdTypeArray& faces, vtkIdType at, vtkIdType numPoints) {
  const vtkIdType end = faces.GetNumberOfValues();
  if (at < 0 || at >= end) return false;
  const vtkIdType numFaces = faces.GetValue(at++);
  if (numFaces < 4) return false;
  for (vtkIdType face = 0; face < numFaces; ++face) {
    if (at >= end) return false;
    const vtkIdType size = faces.GetValue(at++);
    if (size < 3 || size > end - at) return false;
    for (const vtkIdType last = at + size; at < last; ++at)
      if (faces.GetValue(at) < 0 || faces.GetValue(at) >= numPoints) return false;
  }
  return true;
}

bool isSoundGrid(vtkUnstructuredGrid& grid) {
  vtkCellArray* cells = grid.GetCells();
  vtkUnsignedCharArray* types = grid.GetCellTypesArray();
  if (cells == nullptr || types == nullptr) return grid.GetNumberOfCells() == 0;
  if (types->GetNumberOfTuples() != cells->GetNumberOfCells() || !areCells(cells, grid.GetNumberOfPoints()))
    return false;
  vtkDataArray* degrees = grid.GetCellData()->GetHigherOrderDegrees();
  if (degrees != nullptr &&
      (degrees->GetNumberOfComponents() != 3 || degrees->GetNumberOfTuples() != types->GetNumberOfTuples()))
    return false;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell) {
    const int type = types->GetValue(cell);
    if (type != VTK_POLYHEDRON) {
      if (!hasItsSize(type, cells->GetCellSize(cell), degrees, cell)) return false;
      continue;
    }
    vtkIdTypeArray *faces = grid.GetFaces(), *places = grid.GetFaceLocations();
    if (faces == nullptr || places == nullptr || cell >= places->GetNumberOfValues() ||
        !isPolyhedron(*faces, places->GetValue(cell), grid.GetNumberOfPoints()))
      return false;
  }
  return true;
}

}  // namespace

bool isSound(vtkDataSet& data) {
  if (auto* grid = vtkUnstructuredGrid::SafeDownCast(&data)) return isSoundGrid(*grid);
  if (auto* parts = vtkPolyData::SafeDownCast(&data)) {
    for (vtkCellArray* cells : {parts->GetVerts(), parts->GetLines(), parts->GetPolys(), parts->GetStrips()})
      if (!areCells(cells, parts->GetNumberOfPoints())) return false;
    return haveAtLeast(parts->GetVerts(), 1) && haveAtLeast(parts->GetLines(), 2) &&
           haveAtLeast(parts->GetPolys(), 3) && haveAtLeast(parts->GetStrips(), 3);
  }
  return true;  // a lattice has no numbers of points
}

}  // namespace burnish
