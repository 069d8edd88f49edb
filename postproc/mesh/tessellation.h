#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <vector>

#include "engine/results/result.h"

class vtkUnstructuredGrid;

namespace burnish {

/// The body cut into straight cells, `subdivision` per knot span and direction: quadrilaterals in 2D,
/// hexahedra in 3D. Cells of one patch share their points. What a field needs is computed once: a value is
/// Σ R_A q_A.
class Tessellation {
 public:
  /// Throws `Error` if `subdivision` < 1 or the model is inconsistent.
  Tessellation(const ModelRecord& model, int subdivision);

  int dim() const { return dim_; }
  int numPoints() const { return static_cast<int>(values_.rows()); }
  int numCells() const { return static_cast<int>(cells_.cols()); }

  /// Values at the points (components x points) of a field with these coefficients (components x nodes).
  /// Throws `Error` if the number of nodes does not fit.
  Eigen::MatrixXd evaluate(const Eigen::MatrixXd& coefficients) const;

  /// Positions in the reference configuration, dim x points.
  const Eigen::MatrixXd& referencePoints() const { return referencePoints_; }

  /// Points of each cell in VTK's order, 2^dim x cells.
  const Eigen::MatrixXi& cells() const { return cells_; }

  /// Patch number of each cell.
  const std::vector<int>& patchOfCell() const { return patchOfCell_; }

 private:
  int dim_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> values_;  ///< R_A at the points, points x nodes
  Eigen::MatrixXd referencePoints_;
  Eigen::MatrixXi cells_;
  std::vector<int> patchOfCell_;
};

/// A frame as a VTK data set in double precision. Point data: `displacement` (components X Y Z) and every
/// field of the frame under its own name and component names; cell data: `patch`. The points are the current
/// positions if `deformed`, else the reference positions. Throws `Error` if a field does not fit the model.
vtkSmartPointer<vtkUnstructuredGrid> makeGrid(const Tessellation& tessellation, const FrameRecord& frame,
                                              bool deformed);

}  // namespace burnish
