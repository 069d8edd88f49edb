#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/nurbs/patch.h"

/// Functions by their values at anchors (Greville abscissae, nodes).
namespace burnish::inline nurbs {

/// Values of the functions of a basis: parameters x functions.
Eigen::MatrixXd functionValuesAt(const UnivariateBasis& basis, const std::vector<double>& parameters);

/// Values of the functions of a basis at the anchors of another one: anchors x functions.
Eigen::MatrixXd valuesAtAnchors(const UnivariateBasis& basis, const UnivariateBasis& places);

/// Values of a function on one tensor product at the anchors of another one over the same parameters.
/// coefficients: components x functions; components x anchors.
template <int P>
Eigen::MatrixXd valuesAtAnchors(const TensorBasis<P>& basis, const Eigen::MatrixXd& coefficients,
                                const TensorBasis<P>& places);

/// Coefficients on `to` of the function that has the values of the one on `from`, over the same parameters, at
/// all anchors of `to`: the same function where it lies in both spaces, the same polynomial up to their degree
/// in any case, and on a face what it is on the face. coefficients: components x functions.
template <int P>
Eigen::MatrixXd interpolatedOn(const TensorBasis<P>& to, const TensorBasis<P>& from,
                               const Eigen::MatrixXd& coefficients);

}  // namespace burnish::inline nurbs
