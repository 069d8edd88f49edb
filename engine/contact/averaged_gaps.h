#pragma once
#include <Eigen/Dense>

namespace burnish {

/// Averaged gaps are those over the weights A_A = ∫ R_A dΓ (32) of a face: throws `Error` if one is not
/// positive (Lagrange bases above degree 7, or of higher degree than 1 where an axisymmetric face meets the
/// axis).
void requireAveragedGaps(const Eigen::VectorXd& weights, bool axisymmetric);

}  // namespace burnish
