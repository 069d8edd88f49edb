#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "engine/results/result.h"
#include "postproc/mesh/span_points.h"

class vtkUnstructuredGrid;

namespace burnish {

/// The body cut into straight cells, `subdivision` per knot span and direction: quadrilaterals in 2D,
/// hexahedra in 3D. Cells of one patch share their points.
class Tessellation {
 public:
  /// piece: cut alone; null: all of the mesh. Throws `Error` if `subdivision` < 1 or the mesh is inconsistent.
  Tessellation(const MeshRecord& mesh, int subdivision, const MeshPiece* piece = nullptr);

  int dim() const { return points_.dim(); }
  int numPoints() const { return points_.size(); }
  int numCells() const { return static_cast<int>(cells_.cols()); }

  /// Values at the points (components x points) of a field with these coefficients (components x nodes).
  /// Throws `Error` if the number of nodes does not fit.
  Eigen::MatrixXd evaluate(const Eigen::MatrixXd& coefficients) const {
    return points_.evaluate(coefficients);
  }

  /// Positions in the reference configuration, dim x points.
  const Eigen::MatrixXd& referencePoints() const { return points_.referencePoints(); }

  const SpanPoints& points() const { return points_; }

  /// Points of each cell in VTK's order, 2^dim x cells.
  const Eigen::MatrixXi& cells() const { return cells_; }

  /// Patch number of each cell.
  const std::vector<int>& patchOfCell() const { return patchOfCell_; }

 private:
  SpanPoints points_;
  Eigen::MatrixXi cells_;
  std::vector<int> patchOfCell_;
};

/// A frame as a VTK data set in double precision, with the point data of `setPoints` and the cell data
/// `patch`. Throws `Error` if a field does not fit its mesh.
vtkSmartPointer<vtkUnstructuredGrid> makeGrid(const Tessellation& tessellation, const FrameRecord& frame,
                                              bool deformed, const std::string& lengthUnit = {});

}  // namespace burnish
