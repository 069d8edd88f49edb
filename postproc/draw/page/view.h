#pragma once
#include <Eigen/Dense>

namespace burnish {

/// A rectangle of pixels. Pixels are counted from the lower left corner of the picture; pixel (i, j) covers
/// [i, i+1) x [j, j+1).
struct PixelRect {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
  double right() const { return x + width; }
  double top() const { return y + height; }
  Eigen::Vector2d center() const { return {x + width / 2, y + height / 2}; }
  bool operator==(const PixelRect&) const = default;
};

/// Unit vectors of space that go right and up in a picture.
using ViewAxes = Eigen::Matrix<double, 2, 3>;

/// A parallel projection of space into a part of the picture.
struct View {
  ViewAxes axes = ViewAxes::Identity();
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< projected point that lies in the middle of `area`
  double pixelsPerLength = 1.0;
  PixelRect area;  ///< the part of the picture that shows space

  /// Unit vector from the picture towards the eye.
  Eigen::Vector3d towardsEye() const { return axes.row(0).cross(axes.row(1)).transpose(); }

  /// Where a position (2 or 3 coordinates) lies in the picture, in pixels from its lower left corner.
  Eigen::Vector2d pixel(const Eigen::VectorXd& position) const {
    return area.center() + pixelsPerLength * (axes.leftCols(position.size()) * position - center);
  }
};

}  // namespace burnish
