#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <string>
#include <vector>

class vtkCellArray;
class vtkDoubleArray;
class vtkIntArray;
class vtkPoints;

namespace burnish {

/// Points in double precision. positions: 2 or 3 coordinates x points; a missing z is 0.
vtkSmartPointer<vtkPoints> makePoints(const Eigen::MatrixXd& positions);

/// A named array. values: components x tuples; componentNames: one per component, or none.
vtkSmartPointer<vtkDoubleArray> makeArray(const std::string& name, const Eigen::MatrixXd& values,
                                          const std::vector<std::string>& componentNames);

/// A named array with one integer per tuple.
vtkSmartPointer<vtkIntArray> makeIntegers(const std::string& name, const std::vector<int>& values);

/// Cells of equally many points. corners: numbers of the points of each cell x cells.
vtkSmartPointer<vtkCellArray> makeCells(const Eigen::MatrixXi& corners);

/// The name of an array with its unit: `stress [MPa]`, or the name alone without one.
std::string labelled(const std::string& name, const std::string& unit);

/// Names of the components of a vector. VTK's vectors have three, also in the plane.
inline const std::vector<std::string> kAxes{"X", "Y", "Z"};

/// Vectors (2 or 3 components x tuples) with a third component; a missing one is 0.
Eigen::MatrixXd inSpace(const Eigen::MatrixXd& vectors);

}  // namespace burnish
