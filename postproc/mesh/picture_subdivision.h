#pragma once
#include <Eigen/Geometry>
#include <array>

#include "engine/results/result.h"
#include "postproc/mesh/subdivision.h"

namespace burnish {

/// Cells into which a picture cuts a knot span and direction at most, or as much of it as is seen.
inline constexpr int kMostCellsOfPicture = 64;

/// How exact positions in a picture are.
struct PositionTolerance {
  double length = 0.0;         ///< largest distance from the exact position
  Eigen::AlignedBox2d window;  ///< the part of the picture's plane that is seen
  /// The directions of the picture's plane.
  Eigen::Matrix<double, 2, 3> axes = Eigen::Matrix<double, 2, 3>::Identity();
};

/// How exact the values are.
struct ValueTolerance {
  Eigen::MatrixXd coefficients;  ///< components x nodes; of several components the magnitude is drawn
  double value = 0.0;            ///< largest difference from the exact value
  std::array<double, 2> range;   ///< values below or above are not told apart
};

/// The cells of a body, displaced by dim x nodes (empty: undeformed), whose straight triangles are within the
/// tolerances of what can be seen of the body, and, where there are values, of these. A span that is out of sight
/// is one cell. Spans of a row or column have equally many cells, also across edges at which patches meet, so that
/// there are no cracks.
///
/// Linear interpolation on n x m cells of a span is off by at most (M_uu/n² + 2 M_uv/(n m) + M_vv/m²)/8, where
/// M bounds the second derivatives by the span's parameters in [0, 1]². It is within τ for
/// n = sqrt((M_uu + M_uv)/(4 τ)), m = sqrt((M_vv + M_uv)/(4 τ)). M follows from the Bernstein coefficients of the rational
/// span. Where n is too large, but a small part of the span is seen, this part is halved until it is within the tolerances. The
/// magnitude of a vector has a cusp where it is 0, and no such bound: there M is twice the largest second difference of samples, and
/// a part has the cells of its span.
Subdivision pictureSubdivision(const MeshRecord& mesh, const Eigen::MatrixXd& displacement,
                               const PositionTolerance& positions, const ValueTolerance* values);

}  // namespace burnish
