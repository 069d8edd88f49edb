#pragma once
#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

namespace burnish::inline analysis {

/// A straight piece of a boundary in the plane.
struct BoundaryPiece {
  Eigen::Vector2d begin, end;
  std::string face;

  /// Distance to the left of the line through the piece.
  double leftOf(const Eigen::Vector2d& x) const;
};

struct BoundaryCrossing {
  Eigen::Vector2d place;
  std::string first, second;  ///< faces
};

/// A place where two pieces cross: the ends of each lie clearly, farther than `rounding`, on both sides of
/// the other one.
std::optional<BoundaryCrossing> findCrossing(const std::vector<BoundaryPiece>& pieces, double rounding);

}  // namespace burnish::inline analysis
