#pragma once
#include <Eigen/Dense>

class vtkPointSet;

namespace burnish {

/// The part of the cells of the highest dimension that belongs to each point: equal shares of their lengths, areas or
/// volumes; with ofCells each cell's own, 0 for those of lower dimensions. places: of linear cells.
Eigen::VectorXd sizesIn(vtkPointSet& places, bool ofCells);

}  // namespace burnish
