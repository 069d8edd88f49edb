#include "postproc/mesh/tessellation.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkUnstructuredGrid.h>

#include <array>

#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

/// Adds the corners of the cells between the points of a patch and returns the number of cells.
int addCells(const PatchLattice& lattice, int dim, std::vector<int>& corners) {
  const IndexBox points = lattice.points();
  IndexBox cells = points;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d) --cells.extent[d];
  for (int cell = 0; cell < cells.size(); ++cell)
    for (int corner = 0; corner < (1 << dim); ++corner) {
      // VTK goes round the quadrilateral, then round the one above it.
      const std::array<int, 3> offset{(corner ^ (corner >> 1)) & 1, (corner >> 1) & 1, corner >> 2};
      auto index = cells.index(cell);
      for (std::size_t d = 0; d < 3; ++d) index[d] += offset[d];
      corners.push_back(lattice.firstPoint + points.number(index));
    }
  return cells.size();
}

}  // namespace

Tessellation::Tessellation(const MeshRecord& mesh, int subdivision, const MeshPiece* piece)
    : points_(
          mesh, PointMeaning::Value, [=](const DirectionRecord&) { return subdivision; }, piece) {
  std::vector<int> corners;
  for (std::size_t i = 0; i < points_.patches().size(); ++i) {
    const int added = addCells(points_.patches()[i], dim(), corners);
    patchOfCell_.insert(patchOfCell_.end(), static_cast<std::size_t>(added), static_cast<int>(i));
  }
  cells_ = Eigen::Map<const Eigen::MatrixXi>(corners.data(), Eigen::Index{1} << dim(),
                                             static_cast<Eigen::Index>(patchOfCell_.size()));
}

vtkSmartPointer<vtkUnstructuredGrid> makeGrid(const Tessellation& tessellation, const FrameRecord& frame,
                                              bool deformed, const std::string& lengthUnit) {
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  setPoints(*grid, tessellation.points(), frame, deformed, lengthUnit);
  grid->SetCells(tessellation.dim() == 2 ? VTK_QUAD : VTK_HEXAHEDRON, makeCells(tessellation.cells()));
  grid->GetCellData()->AddArray(makeIntegers("patch", tessellation.patchOfCell()));
  return grid;
}

}  // namespace burnish
