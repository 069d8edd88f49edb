#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <string>
#include <vector>

class vtkDoubleArray;
class vtkPoints;

namespace burnish {

/// Points in double precision. positions: 2 or 3 coordinates x points; a missing z is 0.
vtkSmartPointer<vtkPoints> makePoints(const Eigen::MatrixXd& positions);

/// A named array. values: components x tuples; componentNames: one per component, or none.
vtkSmartPointer<vtkDoubleArray> makeArray(const std::string& name, const Eigen::MatrixXd& values,
                                          const std::vector<std::string>& componentNames);

}  // namespace burnish
