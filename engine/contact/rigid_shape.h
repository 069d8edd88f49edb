#pragma once
#include <Eigen/Dense>
#include <variant>

namespace burnish {

/// Answer of a rigid surface for a point x: gap (positive outside the tool), unit normal from the tool
/// towards x, and the curvature term ∂n/∂x (symmetric).
struct GapQuery {
  double gap = 0.0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Matrix3d dNormal = Eigen::Matrix3d::Zero();
};

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

/// The analytic rigid surfaces, in the tool's reference position. 2D scenes live in the plane z = 0.
using RigidShape = std::variant<Plane, Cylinder, Sphere>;

GapQuery queryGap(const RigidShape& shape, const Eigen::Vector3d& x);

/// The point that stands for a shape: its centre, or where a plane was given.
Eigen::Vector3d middleOf(const RigidShape& shape);

/// Length that measures how coarse a penetration is: the radius; infinity for a plane.
double curvatureRadius(const RigidShape& shape);

}  // namespace burnish
