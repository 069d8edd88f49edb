#pragma once
#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <string>
#include <vector>

#include "engine/results/result.h"
#include "postproc/mesh/span_points.h"

class vtkUnstructuredGrid;

namespace burnish {

enum class CurvedFamily {
  Lagrange,  ///< through values at equal steps of the parameters: exact for polynomials only
  Bezier     ///< rational Bernstein polynomials: geometry and fields exactly as computed
};

/// One VTK cell per knot span with the degrees of its patch: curved quadrilaterals in 2D, hexahedra in 3D.
/// Cells of one patch share their points.
class CurvedCells {
 public:
  /// Highest degree of VTK's Lagrange and Bezier cells.
  static constexpr int kHighestDegree = 10;

  /// piece: made alone; null: all of the mesh. Throws `Error` for a degree above `kHighestDegree` or an
  /// inconsistent mesh.
  CurvedCells(const MeshRecord& mesh, CurvedFamily family, const MeshPiece* piece = nullptr);

  CurvedFamily family() const { return family_; }
  const SpanPoints& points() const { return points_; }

  /// Points of each cell in VTK's order.
  const std::vector<std::vector<vtkIdType>>& cells() const { return cells_; }

  /// Patch number of each cell.
  const std::vector<int>& patchOfCell() const { return patchOfCell_; }

 private:
  CurvedFamily family_;
  SpanPoints points_;
  std::vector<std::vector<vtkIdType>> cells_;
  std::vector<int> patchOfCell_;
};

/// A frame on the current positions as a VTK data set in double precision, with the point data of
/// `setPoints`, the cell data `patch` and what VTK needs: degrees and, of Bezier cells, weights. Throws
/// `Error` if a field does not fit its mesh.
vtkSmartPointer<vtkUnstructuredGrid> makeGrid(const CurvedCells& cells, const FrameRecord& frame,
                                              const std::string& lengthUnit);

}  // namespace burnish
