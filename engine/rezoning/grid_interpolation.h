#pragma once
#include <Eigen/Dense>
#include <array>
#include <vector>

namespace burnish::inline rezoning {

/// Values on a tensor grid of parameters, between its points by cubic interpolation in each direction. What
/// is interpolated stays within the range of the three points in each direction around it, so that a steep profile
/// does not overshoot; beyond the outermost points it is continued linearly.
template <int P>
class GridInterpolation {
 public:
  /// coordinates: increasing, at least two per direction. values: components x points, first direction
  /// fastest.
  GridInterpolation(std::array<std::vector<double>, P> coordinates, Eigen::MatrixXd values);

  Eigen::VectorXd operator()(const Eigen::Vector<double, P>& xi) const;

 private:
  /// Points of a direction and what they contribute.
  struct Stencil {
    int first = 0;
    Eigen::VectorXd weights;
    int nearest = 0;
    bool inside = true;
  };

  /// Number of a point.
  Eigen::Index place(const std::array<int, P>& index) const;

  static Stencil stencil(const std::vector<double>& coordinates, double x);

  std::array<std::vector<double>, P> coordinates_;
  Eigen::MatrixXd values_;
};

}  // namespace burnish::inline rezoning
