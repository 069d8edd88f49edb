#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/solid/span_quadrature.h"

namespace burnish {

/// The projection Π of a quadrature-point field onto splines one degree below the body's (Bezier projection:
/// D. C. Thomas, M. A. Scott, J. A. Evans, K. Tew, E. J. Evans, Comput. Methods Appl. Mech. Engrg. 284,
/// 2015): the least-squares fit on each span, whose coefficients are then averaged over the spans of each
/// function. Local, so that what follows from it stays sparse, and it keeps constants and the integral of the
/// field.
///
/// Functions are the B-splines of `derivativeSpace()` without weights, patch by patch; nothing joins two
/// patches.
template <int Dim>
class DilatationProjection {
 public:
  /// m functions and Q points of a span of the quadrature, in the same order.
  struct Span {
    std::vector<int> functions;  ///< m
    Eigen::MatrixXd N;           ///< m x Q values
    Eigen::MatrixXd L;           ///< m x Q: share of the span's point values in the coefficients
    Eigen::VectorXd averaged;    ///< m: weight of the span in the average that a coefficient is
  };

  /// The quadrature must have been made from the same body.
  DilatationProjection(const Body<Dim>& body, const SpanQuadrature<Dim>& quadrature);

  const std::vector<Span>& spans() const { return spans_; }
  int numFunctions() const { return numFunctions_; }

  /// Π applied to values at the quadrature points of the body.
  Eigen::VectorXd project(const SpanQuadrature<Dim>& quadrature, const Eigen::VectorXd& values) const;

 private:
  std::vector<Span> spans_;
  int numFunctions_ = 0;
};

}  // namespace burnish
