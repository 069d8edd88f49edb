#pragma once
#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <array>

#include "engine/nurbs/patch.h"

namespace burnish {

/// The nearest points of a face of a body, a curve in the plane and a surface in space.
template <int Dim>
class NearestOnFace {
 public:
  using Parameter = Eigen::Vector<double, Dim - 1>;
  using Point = Eigen::Vector<double, Dim>;

  struct Found {
    Parameter xi;
    Point point;  ///< of the face
    /// The way there is normal to the face; else it ends at the border and comes from beyond.
    bool isFoot = false;
    double tilt = 0.0;                ///< sine of the angle between the way and the normal, 0 of a foot
    std::array<int, Dim - 1> ends{};  ///< -1 and 1 at the begin and the end of a parameter, 0 between them
  };

  explicit NearestOnFace(Patch<Dim - 1, Dim> face);

  /// By Newton's method that stays in the face, from the nearest one of some points all over it.
  Found operator()(const Point& position) const;

  const Patch<Dim - 1, Dim>& face() const { return face_; }

  /// Covers these points, the corners among them.
  const Eigen::AlignedBox<double, Dim>& box() const { return box_; }

 private:
  struct Place;

  Place placeAt(const Parameter& xi, const Point& position) const;
  Parameter step(const Place& place) const;
  Parameter clamped(const Parameter& xi) const;

  Patch<Dim - 1, Dim> face_;
  Parameter low_, high_;  ///< ends of the parameters
  Eigen::Matrix<double, Dim - 1, Eigen::Dynamic> starts_;
  Eigen::Matrix<double, Dim, Eigen::Dynamic> startPoints_;
  Eigen::AlignedBox<double, Dim> box_;
};

}  // namespace burnish
