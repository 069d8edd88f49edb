#pragma once
#include <Eigen/Dense>
#include <array>
#include <string>
#include <vector>

#include "engine/nurbs/univariate_basis.h"

namespace burnish::inline nurbs {

/// Tensor product of P univariate bases. Functions and spans are numbered with the first direction fastest.
template <int P>
class TensorBasis {
 public:
  using Index = std::array<int, P>;

  explicit TensorBasis(std::vector<UnivariateBasis> directions);

  const UnivariateBasis& direction(int d) const { return directions_[static_cast<std::size_t>(d)]; }
  int numFunctions() const;
  int numSpans() const;
  int functionsPerSpan() const;

  Index spanIndex(int span) const;
  int spanNumber(const Index& index) const;
  Index functionIndex(int function) const;
  int functionNumber(const Index& index) const;

  /// Anchors of a function in all directions: the parameter point that it belongs to.
  Eigen::Vector<double, P> anchor(int function) const;

  /// Numbers of the functions that live on a span, first direction fastest: `functionsPerSpan()` entries.
  std::vector<int> spanFunctions(int span) const;

 private:
  std::vector<UnivariateBasis> directions_;
};

/// Rational basis functions R_A (21) of one span at one parameter point.
template <int P>
struct RationalShape {
  Eigen::VectorXd R;                            ///< values, n = functions per span
  Eigen::Matrix<double, Eigen::Dynamic, P> dR;  ///< derivatives with respect to the parameters, n x P
};

/// A rational tensor-product patch with P parameters in S-dimensional space (curve, surface, volume).
template <int P, int S = P>
class Patch {
 public:
  using Parameter = Eigen::Matrix<double, P, 1>;
  using Point = Eigen::Matrix<double, S, 1>;

  /// points: S x numFunctions (Cartesian, not premultiplied by weights); weights: numFunctions, all > 0.
  /// Throws `Error` on a size mismatch or a weight that is not positive.
  Patch(TensorBasis<P> basis, Eigen::MatrixXd points, Eigen::VectorXd weights);

  const TensorBasis<P>& basis() const { return basis_; }
  const Eigen::MatrixXd& points() const { return points_; }
  const Eigen::VectorXd& weights() const { return weights_; }

  RationalShape<P> shape(int span, const Parameter& xi) const;

  /// Position of a parameter point: Σ R_A X_A.
  Point position(const Parameter& xi) const;

  /// Derivative of the position, S x P.
  Eigen::Matrix<double, S, P> jacobian(const Parameter& xi) const;

  /// Span that contains a parameter point.
  int findSpan(const Parameter& xi) const;

 private:
  TensorBasis<P> basis_;
  Eigen::MatrixXd points_;
  Eigen::VectorXd weights_;
};

/// The 2P faces of a patch, numbered 2d (parameter d at its start) and 2d+1 (at its end).
using FaceId = int;

/// Face number of "left right bottom top back front"; throws `Error` naming the allowed names for P
/// parameters.
template <int P>
FaceId faceFromName(const std::string& name);

/// The name of a face: left, right, bottom, top, back or front.
const char* faceName(FaceId face);

/// Numbers of a patch's functions that do not vanish on a face, in the order of the face's own tensor
/// product.
template <int P>
std::vector<int> faceFunctions(const TensorBasis<P>& basis, FaceId face);

/// The trace of a patch on one of its faces, eq. (25): the same tensor product with one direction less.
template <int P, int S>
Patch<P - 1, S> tracePatch(const Patch<P, S>& patch, FaceId face);

}  // namespace burnish::inline nurbs
