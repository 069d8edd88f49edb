#pragma once
#include <Eigen/Core>

#include "engine/material/mandel.h"

namespace burnish::inline material {

/// Eigenvalues of a symmetric tensor, and its eigenvectors as the columns of an orthogonal matrix; for Dim 2 the third
/// one is the direction out of the plane.
template <int Dim>
struct EigenSystem {
  explicit EigenSystem(const Eigen::Matrix3d& T);

  /// Σ f(value_A) n_A ⊗ n_A.
  template <class F>
  Eigen::Matrix3d function(const F& f) const {
    return vectors * values.unaryExpr(f).asDiagonal() * vectors.transpose();
  }

  Eigen::Vector3d values;
  Eigen::Matrix3d vectors;
};

/// The second divided difference of the logarithm, (p_ab − p_bc)/(a − c) with p_ab = (ln a − ln b)/(a − b), of positive
/// numbers that may be equal: to 13 digits however near they are.
double secondDifferenceOfLog(double a, double b, double c);

/// The logarithmic strain E = ½ ln FᵀF, by which a law T(E) of small strains becomes one of finite strains (C. Miehe,
/// N. Apel, M. Lambrecht, Comput. Methods Appl. Mech. Engrg. 191, 2002). E and T are referred to the axes that F starts
/// from; T need not be coaxial with E. With the principal axes N_A of E, n_A = R N_A, and F = R U,
///
///     τ_AB = p̂_AB T_AB                                          p̂_AB = x/sinh x,  x = e_A − e_B
///     h:c:g = Σ p̂_AB h_AB D_ABCD p̂_CD g_CD + Σ q̂_AKB T_AB (h_AK g_KB + g_AK h_KB),
///
/// where q̂_AKB = 2 λ_A λ_B λ_K² times the second divided difference of ln at λ_A², λ_K², λ_B².
template <int Dim>
class LogarithmicStrain {
 public:
  explicit LogarithmicStrain(const Eigen::Matrix3d& F);

  /// Whether F has stretches that are positive and finite; otherwise nothing else is to be asked.
  bool isDefined() const { return isDefined_; }

  const MandelVector<Dim>& value() const { return E_; }

  /// R.
  Eigen::Matrix3d rotation() const { return spatial_ * material_.transpose(); }

  /// Sets the Kirchhoff stress and its spatial tangent from T and D = ∂T/∂E, which need not be symmetric.
  void setResponse(const MandelVector<Dim>& T, const MandelMatrix<Dim>& D, MaterialResponse<Dim>& out) const;

 private:
  bool isDefined_ = false;
  Eigen::Vector3d squares_;   ///< λ_A²
  Eigen::Vector3d logs_;      ///< e_A
  Eigen::Matrix3d material_;  ///< columns N_A
  Eigen::Matrix3d spatial_;   ///< columns n_A
  MandelVector<Dim> E_;
};

/// exp(E).
template <int Dim>
Eigen::Matrix3d exponential(const MandelVector<Dim>& E);

/// ½ ln b of a positive tensor.
template <int Dim>
MandelVector<Dim> halfLogarithm(const Eigen::Matrix3d& b);

}  // namespace burnish::inline material
