#pragma once
#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "engine/solid/body.h"

namespace burnish {

/// Quadrature over the reference surface of one face: the trace of a patch (25), with basis values and area
/// weights.
template <int Dim>
class FaceQuadrature {
 public:
  struct Span {
    std::vector<int> functions;  ///< n functions of the trace, numbered as in `nodes()`
    int firstPoint = 0;
    Eigen::MatrixXd R;        ///< n x Q
    Eigen::VectorXd weights;  ///< Q: weight times reference area
  };

  /// Degree + 1 points per direction and span unless `pointsPerDirection` is positive.
  FaceQuadrature(const Body<Dim>& body, int patch, FaceId face, int pointsPerDirection);

  const std::vector<Span>& spans() const { return spans_; }

  /// Node of the body behind each function of the trace.
  const std::vector<int>& nodes() const { return nodes_; }

  /// Reference positions of the trace's control points, Dim x functions.
  const Eigen::MatrixXd& points() const { return points_; }

  int numFunctions() const { return static_cast<int>(nodes_.size()); }
  int numPoints() const { return numPoints_; }

  /// Length (2D) or square root of the area of a span.
  static double sizeOf(const Span& span) {
    return Dim == 2 ? span.weights.sum() : std::sqrt(span.weights.sum());
  }

 private:
  std::vector<Span> spans_;
  std::vector<int> nodes_;
  Eigen::MatrixXd points_;
  int numPoints_ = 0;
};

}  // namespace burnish
