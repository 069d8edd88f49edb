#pragma once
#include <Eigen/Dense>

#include "engine/nurbs/patch.h"

namespace burnish::inline nurbs {

/// Number of the second derivative by parameters a and b among the P(P+1)/2 different ones: those by one
/// parameter twice come first, then the mixed one.
constexpr int secondDerivative(int a, int b) {
  return a == b ? a : 2;
}

/// Rational basis functions R_A (21) of one span at one parameter point with two derivatives; n functions.
template <int P>
struct SecondOrderShape {
  Eigen::VectorXd R;                                         ///< n
  Eigen::Matrix<double, Eigen::Dynamic, P> dR;               ///< n x P
  Eigen::Matrix<double, Eigen::Dynamic, P*(P + 1) / 2> ddR;  ///< n x P(P+1)/2, see `secondDerivative`
};

/// P is 1 or 2. weights: of all functions. Beyond the ends of the span the weighted polynomials of numerator
/// and denominator are continued linearly, direction by direction: a curve goes on straight along its tangent.
template <int P>
SecondOrderShape<P> secondOrderShape(const TensorBasis<P>& basis, const Eigen::VectorXd& weights, int span,
                                     const Eigen::Vector<double, P>& xi);

/// ∂R_A/∂ξ^d by one parameter d, n x 1 if P = 1; if P = 2 with the first and second derivatives of that by the
/// other parameter, n x 3.
template <int P>
Eigen::MatrixXd crossingDerivatives(const TensorBasis<P>& basis, const Eigen::VectorXd& weights, int span,
                                    const Eigen::Vector<double, P>& xi, int direction);

}  // namespace burnish::inline nurbs
