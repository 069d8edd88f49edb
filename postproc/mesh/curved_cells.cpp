#include "postproc/mesh/curved_cells.h"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkHigherOrderHexahedron.h>
#include <vtkHigherOrderQuadrilateral.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include "engine/core/error.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

int checkedDegree(const DirectionRecord& direction) {
  if (direction.degree > CurvedCells::kHighestDegree)
    throw Error(
        fmt::format("found a patch of degree {}; Lagrange and Bezier cells have degrees up to {}; linear "
                    "cells take every degree",
                    direction.degree, CurvedCells::kHighestDegree));
  return direction.degree;
}

PointMeaning meaningFor(CurvedFamily family) {
  return family == CurvedFamily::Bezier ? PointMeaning::Coefficient : PointMeaning::Value;
}

int cellType(CurvedFamily family, int dim) {
  if (family == CurvedFamily::Bezier) return dim == 2 ? VTK_BEZIER_QUADRILATERAL : VTK_BEZIER_HEXAHEDRON;
  return dim == 2 ? VTK_LAGRANGE_QUADRILATERAL : VTK_LAGRANGE_HEXAHEDRON;
}

std::vector<vtkIdType> pointsOfSpan(const PatchLattice& lattice, const IndexBox::Index& span, int dim) {
  IndexBox local;
  for (std::size_t d = 0; d < 3; ++d) local.extent[d] = lattice.steps[d] + 1;
  std::vector<vtkIdType> points(static_cast<std::size_t>(local.size()));
  const int* degrees = lattice.steps.data();
  for (int i = 0; i < local.size(); ++i) {
    const auto index = local.index(i);
    const int place =
        dim == 2 ? vtkHigherOrderQuadrilateral::PointIndexFromIJK(index[0], index[1], degrees)
                 : vtkHigherOrderHexahedron::PointIndexFromIJK(index[0], index[1], index[2], degrees);
    points[static_cast<std::size_t>(place)] = lattice.point(span, index);
  }
  return points;
}

/// Three degrees per cell; the third of a surface is 1, which VTK does not look at.
Eigen::MatrixXd degreesOf(const CurvedCells& cells) {
  Eigen::MatrixXd degrees = Eigen::MatrixXd::Ones(3, static_cast<Eigen::Index>(cells.patchOfCell().size()));
  for (Eigen::Index cell = 0; cell < degrees.cols(); ++cell) {
    const int patch = cells.patchOfCell()[static_cast<std::size_t>(cell)];
    const auto& steps = cells.points().patches()[static_cast<std::size_t>(patch)].steps;
    for (int d = 0; d < cells.points().dim(); ++d) degrees(d, cell) = steps[static_cast<std::size_t>(d)];
  }
  return degrees;
}

}  // namespace

CurvedCells::CurvedCells(const MeshRecord& mesh, CurvedFamily family, const MeshPiece* piece)
    : family_(family), points_(mesh, meaningFor(family), checkedDegree, piece) {
  for (std::size_t i = 0; i < points_.patches().size(); ++i) {
    const PatchLattice& lattice = points_.patches()[i];
    for (int span = 0; span < lattice.spans.size(); ++span) {
      cells_.push_back(pointsOfSpan(lattice, lattice.spans.index(span), mesh.dim()));
      patchOfCell_.push_back(static_cast<int>(i));
    }
  }
}

vtkSmartPointer<vtkUnstructuredGrid> makeGrid(const CurvedCells& cells, const FrameRecord& frame,
                                              const std::string& lengthUnit) {
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  setPoints(*grid, cells.points(), frame, true, lengthUnit);
  const int type = cellType(cells.family(), cells.points().dim());
  for (const auto& points : cells.cells())
    grid->InsertNextCell(type, static_cast<vtkIdType>(points.size()), points.data());
  grid->GetCellData()->AddArray(makeIntegers("patch", cells.patchOfCell()));
  grid->GetCellData()->SetHigherOrderDegrees(makeArray("HigherOrderDegrees", degreesOf(cells), {}));
  if (cells.family() == CurvedFamily::Bezier)
    grid->GetPointData()->SetRationalWeights(
        makeArray("RationalWeights", cells.points().weights().transpose(), {}));
  return grid;
}

}  // namespace burnish
