#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <vector>

class vtkPolyData;

namespace burnish {

/// Lines along the vectors of a plane surface through seeds, each from its begin to its end (3 x points), about as far
/// from one another as `distance` and not shorter than it: a line ends where it comes within half of the distance of
/// one before it, and a seed that is closer than the distance to one has none. surface: polygons with the point data
/// `vectors`. normal: of its plane. Where vectors are below a hundredth of the largest there are none, and none at
/// all where all vectors are 0.
std::vector<Eigen::Matrix3Xd> evenStreamlines(vtkPolyData& surface, const Eigen::Vector3d& normal,
                                              const std::vector<Eigen::Vector3d>& seeds, double distance);

}  // namespace burnish
