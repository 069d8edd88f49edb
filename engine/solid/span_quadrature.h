#pragma once
#include <Eigen/Dense>
#include <array>
#include <vector>

#include "engine/solid/body.h"

namespace burnish::inline solid {

/// What makes the values and gradients of a span with three directions of univariate functions, with `points`
/// in each: R_a = w_a N_a / Σ_b w_b N_b and ∇_X R_a = w_a Σ_m D_m N_a map_m, where D_m N_a is the product of the
/// univariate functions with the one in direction m differentiated, and without derivatives for m = 3. They
/// take a seventh of the memory of what they make at degree 2.
struct TensorFactors {
  std::array<Eigen::MatrixXd, 3> N;              ///< per direction p+1 x 2·points: values, then derivatives
  Eigen::VectorXd weights;                       ///< n weights w_a
  Eigen::Matrix<double, 4, Eigen::Dynamic> map;  ///< 4 x 3·Q, columns 3·q + d

  /// n x Q values.
  void makeValues(Eigen::MatrixXd& R) const;

  /// n x 3·Q gradients, columns 3·q + d.
  void makeGradients(Eigen::MatrixXd& G) const;
};

/// The quadrature of a body, with everything the total Lagrangian form freezes: basis values, reference
/// gradients (in space what makes them) and weights at all Gauss-Legendre points of all knot spans.
template <int Dim>
class SpanQuadrature {
 public:
  /// One knot span of one patch, with `n` functions and `Q` points.
  struct Span {
    int patch = 0;
    int number = 0;           ///< span of the patch's basis
    std::vector<int> nodes;   ///< n nodes
    int firstPoint = 0;       ///< number of its first quadrature point in the body
    Eigen::MatrixXd xi;       ///< Dim x Q parameters
    Eigen::VectorXd weights;  ///< Q: weight times det(∂X/∂ξ), and times 2πR in axisymmetry
    double size = 0.0;        ///< square root of its area (2D) or cube root of its volume
    TensorFactors factors;    ///< Dim 3 only, else empty
    struct {
      Eigen::MatrixXd R, G;
    } stored;  ///< Dim 2 only, else empty: what `values` and `gradients` give

    /// n x Q values R_a; in space made in the buffer, which has to stay.
    const Eigen::MatrixXd& values(Eigen::MatrixXd& buffer) const;

    /// n x C·Q reference gradients ∇_X R_a, columns C·q + d with C = `kColumns`; in space made in the buffer,
    /// which has to stay.
    const Eigen::MatrixXd& gradients(Eigen::MatrixXd& buffer) const;
  };

  /// p+1 points per direction and span unless `pointsPerDirection` is positive.
  /// Throws `Error` if the map from parameters to space is folded (det <= 0) at a point, or if a point of an
  /// axisymmetric body is not on the positive side of the axis.
  explicit SpanQuadrature(const Body<Dim>& body, int pointsPerDirection = 0);

  const std::vector<Span>& spans() const { return spans_; }
  int numPoints() const { return numPoints_; }
  int numNodes() const { return numNodes_; }
  Kinematics kinematics() const { return kinematics_; }

  /// Volume of the body (area in plane strain, whole rings in axisymmetry).
  double volume() const;

 private:
  Span makeSpan(const Body<Dim>& body, std::size_t patch, int number, int pointsPerDirection) const;

  Kinematics kinematics_;
  std::vector<Span> spans_;
  int numPoints_ = 0;
  int numNodes_ = 0;
};

/// Parameter points and weights of the tensor-product rule with n points per direction, first direction
/// fastest.
template <int P>
struct SpanRule {
  std::vector<Eigen::Vector<double, P>> points;
  std::vector<double> weights;  ///< in parameter space
};

/// A box of parameters.
template <int P>
struct ParameterBox {
  Eigen::Vector<double, P> begin, end;
};

template <int P>
ParameterBox<P> spanBox(const TensorBasis<P>& basis, int span);

template <int P>
SpanRule<P> boxRule(const ParameterBox<P>& box, int pointsPerDirection);

template <int P>
SpanRule<P> spanRule(const TensorBasis<P>& basis, int span, int pointsPerDirection) {
  return boxRule(spanBox(basis, span), pointsPerDirection);
}

}  // namespace burnish::inline solid
