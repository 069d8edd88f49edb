#pragma once
#include <Eigen/Dense>
#include <optional>

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

/// Unit vector from a picture with these axes towards the eye.
inline Eigen::Vector3d towardsEye(const ViewAxes& axes) {
  return axes.row(0).cross(axes.row(1)).transpose();
}

/// An eye at a finite distance that looks straight at a plane across the line of sight. Lengths in this plane are
/// those of the picture, and what lies behind it is seen smaller.
struct Eye {
  Eigen::Vector2d at;     ///< coordinates along the axes of the view
  double plane = 0.0;     ///< coordinate of the plane along the direction towards the eye
  double distance = 1.0;  ///< from the plane

  Eigen::Vector3d position(const ViewAxes& axes) const {
    return axes.transpose() * at + (plane + distance) * towardsEye(axes);
  }

  /// How much larger a length at a point in space is seen than one in the plane.
  double magnification(const ViewAxes& axes, const Eigen::Vector3d& point) const {
    return distance / (plane + distance - towardsEye(axes).dot(point));
  }

  /// Where points in space (3 x points, before the eye) are seen in the plane: coordinates along the axes.
  Eigen::Matrix2Xd project(const ViewAxes& axes, const Eigen::Matrix3Xd& points) const {
    Eigen::Matrix2Xd projected = axes * points;
    for (Eigen::Index k = 0; k < points.cols(); ++k)
      projected.col(k) = at + magnification(axes, points.col(k)) * (projected.col(k) - at);
    return projected;
  }
};

/// A projection of space into a part of the picture: parallel, or of an eye.
struct View {
  ViewAxes axes = ViewAxes::Identity();
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< projected point that lies in the middle of `area`
  double pixelsPerLength = 1.0;
  PixelRect area;            ///< the part of the picture that shows space
  std::optional<Eye> eye{};  ///< looks at the plane to which `center` and `pixelsPerLength` belong

  /// Unit vector from the picture towards the eye.
  Eigen::Vector3d towardsEye() const { return burnish::towardsEye(axes); }

  /// The same from a point in space.
  Eigen::Vector3d towardsEye(const Eigen::Vector3d& point) const {
    return eye ? (eye->position(axes) - point).normalized() : towardsEye();
  }

  /// Pixels per length at a point in space.
  double pixelsPerLengthAt(const Eigen::Vector3d& point) const {
    return eye ? pixelsPerLength * eye->magnification(axes, point) : pixelsPerLength;
  }

  /// Where a position (2 or 3 coordinates) lies in the picture, in pixels from its lower left corner.
  Eigen::Vector2d pixel(const Eigen::VectorXd& position) const {
    if (eye) return area.center() + pixelsPerLength * (eye->project(axes, position) - center);
    return area.center() + pixelsPerLength * (axes.leftCols(position.size()) * position - center);
  }
};

}  // namespace burnish
