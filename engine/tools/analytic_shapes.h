#pragma once
#include <Eigen/Dense>

#include "engine/tools/gap_query.h"

/// Tools whose distance is known in closed form. Directions may have any length but zero.
namespace burnish {

/// Half space below a plane: the tool occupies (x - origin)·normal < 0. A line in 2D.
struct Plane {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();
  GapQuery query(const Eigen::Vector3d& x) const;
};

/// Solid cylinder of infinite length; a disc in 2D, where the axis is z.
struct Cylinder {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double radius = 1.0;
  GapQuery query(const Eigen::Vector3d& x) const;
};

struct Sphere {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 1.0;
  GapQuery query(const Eigen::Vector3d& x) const;
};

/// Wedge between two half planes, its edge rounded by a radius (0: sharp).
struct Edge {
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();          ///< foremost point of the rounding
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitY();  ///< from the tool to the front
  Eigen::Vector3d along = Eigen::Vector3d::UnitZ();       ///< of the edge; z in 2D
  double halfAngle = 0.7853981633974483;                  ///< between a flank and the middle, below π/2
  double radius = 0.0;
  GapQuery query(const Eigen::Vector3d& x) const;
};

/// Circular cone of infinite length, its tip rounded by a radius (0: sharp).
struct Cone {
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();          ///< foremost point of the rounding
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();  ///< from the tool to the front
  double halfAngle = 0.7853981633974483;                  ///< between the flank and the axis, below π/2
  double radius = 0.0;
  GapQuery query(const Eigen::Vector3d& x) const;
};

struct Torus {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double radius = 1.0;       ///< of the circle in the middle of the tube
  double tubeRadius = 0.25;  ///< smaller than `radius`
  GapQuery query(const Eigen::Vector3d& x) const;
};

/// Box with edges rounded by a radius (0: sharp); a rectangle in 2D, where the third size is infinite.
struct RoundedBox {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d size = Eigen::Vector3d::Ones();      ///< along its axes, with the rounding
  double radius = 0.0;                                 ///< at most half the smallest size
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns, orthonormal
  GapQuery query(const Eigen::Vector3d& x) const;
};

}  // namespace burnish
