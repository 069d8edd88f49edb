#pragma once
#include <Eigen/Dense>
#include <array>
#include <vector>

#include "engine/solid/body.h"

namespace burnish::inline fields {

struct Extremes {
  double min = 0.0;
  double max = 0.0;
};

/// Extremes of scalar fields Σ R_A q_A over a grid of equally spaced points on every knot span, ends
/// included.
template <int Dim>
class SpanExtremes {
 public:
  /// The body must outlive the object.
  explicit SpanExtremes(const Body<Dim>& body, int pointsPerDirection = 11);

  /// coefficients: one per node.
  Extremes operator()(const Eigen::VectorXd& coefficients) const;

 private:
  const Body<Dim>& body_;
  int points_;
  /// Per patch, direction and span: basis values at the grid points, points x (p+1).
  std::vector<std::array<std::vector<Eigen::MatrixXd>, Dim>> values_;
};

}  // namespace burnish::inline fields
