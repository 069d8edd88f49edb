#pragma once
#include <vtkPointSet.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <Eigen/Dense>
#include <array>

/// Curved cells as linear ones, for what VTK does with linear cells alone: it cuts through the points of curved ones,
/// which may be far from the cell, as may be what stands at them from its values.
namespace burnish {

/// Whether some of the cells are curved.
bool hasCurved(vtkUnstructuredGrid& cells);

/// Whether points of some of the cells have coefficients, and not values.
bool hasBezier(vtkUnstructuredGrid& cells);

/// The cells where a function may have values between two ends, with linear parts instead of curved ones. Parts have
/// the places and all values that their cell has there, and its number in the cell data `cell`; those that meet share
/// their points as the cells do. of: the function at the points of the grid. most: parts, beyond which they are coarser,
/// down to two along an edge.
inline constexpr vtkIdType kMostLinearParts = 1'000'000;
vtkSmartPointer<vtkUnstructuredGrid> linearParts(vtkUnstructuredGrid& cells, const Eigen::VectorXd& of,
                                                 const std::array<double, 2>& ends,
                                                 vtkIdType most = kMostLinearParts);

/// Where points have the vectors `drawn_vector`, whose lengths `drawn` is, takes these lengths anew: between the
/// points of a curved cell they are no means of those there. The vectors are gone then.
void takeLengths(vtkPointSet& places);

}  // namespace burnish
