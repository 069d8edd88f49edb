#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/tools/rigid_shape.h"

namespace burnish::test {

/// Points around a middle, equally likely in a box of the given half size; in the plane z = 0 if `dim` is 2.
class RandomPoints {
 public:
  RandomPoints(const Eigen::Vector3d& middle, double halfSize, int dim, unsigned seed = 1)
      : middle_(middle), dim_(dim), generator_(seed), offset_(-halfSize, halfSize) {}

  Eigen::Vector3d next() {
    Eigen::Vector3d x = middle_;
    for (int d = 0; d < dim_; ++d) x(d) += offset_(generator_);
    return x;
  }

 private:
  Eigen::Vector3d middle_;
  int dim_;
  std::mt19937 generator_;
  std::uniform_real_distribution<double> offset_;
};

/// Gradient and second derivative of a gap by central differences with step h.
inline GapQuery differences(const RigidShape& shape, const Eigen::Vector3d& x, double h) {
  GapQuery found;
  found.gap = shape.query(x).gap;
  for (int d = 0; d < 3; ++d) {
    const GapQuery forward = shape.query(x + h * Eigen::Vector3d::Unit(d));
    const GapQuery backward = shape.query(x - h * Eigen::Vector3d::Unit(d));
    found.normal(d) = (forward.gap - backward.gap) / (2.0 * h);
    found.dNormal.col(d) = (forward.normal - backward.normal) / (2.0 * h);
  }
  return found;
}

/// How well the derivatives of a gap agree with differences at many points.
struct DerivativeCheck {
  int points = 0;       ///< that were looked at
  int astray = 0;       ///< points where a derivative is off by more than the tolerance
  double normal = 0.0;  ///< largest errors at the others
  double dNormal = 0.0;
};

/// At random points whose gap is in [low, high]; components in z count in 3D only. A few points may be
/// astray: those within the step of a crease of the gap.
inline DerivativeCheck checkDerivatives(const RigidShape& shape, RandomPoints points, int dim, double low,
                                        double high, double tolerance = 1e-5, double h = 1e-6) {
  DerivativeCheck check;
  for (int k = 0; k < 200'000 && check.points < 2'000; ++k) {
    const Eigen::Vector3d x = points.next();
    const GapQuery found = shape.query(x);
    if (found.gap < low || found.gap > high) continue;
    ++check.points;
    const GapQuery expected = differences(shape, x, h);
    const double normal = (found.normal - expected.normal).head(dim).norm();
    const double dNormal = (found.dNormal - expected.dNormal).topLeftCorner(dim, dim).norm() /
                           (1.0 + expected.dNormal.topLeftCorner(dim, dim).norm());
    if (normal > tolerance || dNormal > tolerance) {
      ++check.astray;
      continue;
    }
    check.normal = std::max(check.normal, normal);
    check.dNormal = std::max(check.dNormal, dNormal);
  }
  return check;
}

/// Smallest distance from x to any of the points.
inline double bruteDistance(const Eigen::Matrix3Xd& surface, const Eigen::Vector3d& x) {
  return (surface.colwise() - x).colwise().norm().minCoeff();
}

}  // namespace burnish::test
