#pragma once
#include <Eigen/Dense>
#include <cstddef>
#include <utility>
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
  /// A span whose point values take part in the projected field on another one.
  struct Neighbour {
    std::size_t span;
    std::vector<int> places;                  ///< of its nodes in the other span's `nodes`
    std::vector<std::pair<int, int>> shared;  ///< functions that live on both: place on the other span, on it
  };

  /// m functions and Q points of a span of the quadrature, in the same order.
  struct Span {
    std::vector<int> functions;  ///< m
    Eigen::MatrixXd N;           ///< m x Q values
    Eigen::MatrixXd L;           ///< m x Q: share of the span's point values in the coefficients
    std::vector<int> nodes;      ///< on which the projected field depends here; the span's own come first
    std::vector<Neighbour> neighbours;  ///< the span itself among them
  };

  /// The quadrature must have been made from the same body.
  DilatationProjection(const Body<Dim>& body, const SpanQuadrature<Dim>& quadrature);

  const std::vector<Span>& spans() const { return spans_; }
  int numFunctions() const { return numFunctions_; }

 private:
  void findNeighbours(const SpanQuadrature<Dim>& quadrature);

  std::vector<Span> spans_;
  int numFunctions_ = 0;
};

}  // namespace burnish
