#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

namespace burnish {

/// The symmetric tensor of these components, named xx, xy, ...; those that are not named are 0.
inline Eigen::Matrix3d symmetricTensor(const std::vector<std::string>& components,
                                       const Eigen::VectorXd& values) {
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < components.size(); ++k) {
    const int row = components[k][0] - 'x', column = components[k][1] - 'x';
    tensor(row, column) = tensor(column, row) = values(static_cast<Eigen::Index>(k));
  }
  return tensor;
}

}  // namespace burnish
