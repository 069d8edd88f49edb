#pragma once
#include <Eigen/Dense>

#include "engine/core/blas.h"
#include "engine/solid/kinematics.h"
#include "engine/solid/span_quadrature.h"

namespace burnish {

/// c_ijkl + δ_ik τ_jl between gradient columns j of component i and l of component k.
template <Kinematics K, class Stress, class Tangent>
double modulus(int i, int j, int k, int l, const Stress& tau, const Tangent& c) {
  const int first = gradientPlace<K>(i, j), second = gradientPlace<K>(k, l);
  if (first < 0 || second < 0) return 0.0;
  // Axisymmetry: τ has no component that couples the plane with the third direction.
  if (K == Kinematics::Axisymmetric && (j == 2) != (l == 2)) return c(first, second);
  return c(first, second) + (i == k ? tau(voigtPlace(j, l)) : 0.0);
}

/// Forces and tangent of one span, Σ_q g τ and Σ_q g (c + δτ) gᵀ, by one matrix product over all its
/// quadrature points. Buffers keep their memory from span to span.
template <Kinematics K>
class SpanKernel {
 public:
  static constexpr int kDim = kDimOf<K>;
  using Stress = Eigen::Vector<double, kVoigt<kDim>>;
  using Tangent = Eigen::Matrix<double, kVoigt<kDim>, kVoigt<kDim>>;

  /// Begins a span; its gradients must outlive the work on it.
  void start(const typename SpanQuadrature<kDim>::Span& span, const Eigen::MatrixXd& gradients,
             bool wantTangent) {
    gradients_ = &gradients;
    const Eigen::Index n = gradients.rows(), Q = span.weights.size();
    n_ = n;
    stressRow_ = wantTangent ? kPairs * n : 0;
    g_.resize(n, kC * Q);
    h_.resize(stressRow_ + kDim, kC * Q);
  }

  /// Sets the gradients at point q from the deformation gradient; to be called first.
  void setGradients(Eigen::Index q, const Eigen::Matrix3d& F) {
    g_.template middleCols<kC>(kC * q).noalias() =
        gradients_->template middleCols<kC>(kC * q) * pushForward<K>(F);
  }

  /// Stress that makes the forces, times the weight.
  void setStress(Eigen::Index q, const Stress& weighted) {
    for (int i = 0; i < kDim; ++i)
      for (int j = 0; j < kC; ++j)
        h_(stressRow_ + i, kC * q + j) = gradientPlace<K>(i, j) < 0 ? 0.0 : weighted(gradientPlace<K>(i, j));
  }

  /// Moduli of D : c : D + (D τ) : D + r tr(D D), with D the spatial gradient, times the weight w.
  void setModuli(Eigen::Index q, double w, const Stress& tau, const Tangent& c, double r) {
    const auto g = g_.template middleCols<kC>(kC * q);
    Eigen::Index pair = 0;
    for (int i = 0; i < kDim; ++i)
      for (int k = i; k < kDim; ++k, ++pair) {
        Eigen::Matrix<double, kC, kC> moduli = Eigen::Matrix<double, kC, kC>::Zero();
        for (int j = 0; j < kC; ++j)
          for (int l = 0; l < kC; ++l) moduli(j, l) = w * modulus<K>(i, j, k, l, tau, c);
        moduli(k, i) += w * r;
        if (K == Kinematics::Axisymmetric && k == 0) moduli(2, 2) += w * r;
        h_.template block<Eigen::Dynamic, kC>(pair * n_, kC * q, n_, kC).noalias() = g * moduli;
      }
  }

  /// To be called when all points are set.
  void multiply() { multiplyTransposed(h_, g_, blocks_); }

  /// Force on function a.
  Eigen::Vector<double, kDim> force(Eigen::Index a) const {
    return blocks_.col(a).template segment<kDim>(stressRow_);
  }

  /// Entry (d, e) of the tangent for all pairs of functions, n x n, d <= e; the other ones are their
  /// transposes.
  auto tangentBlock(int d, int e) const {
    return blocks_.middleRows((d * kDim - d * (d - 1) / 2 + e - d) * n_, n_);
  }

 private:
  static constexpr int kC = kColumns<K>;
  /// Pairs (i, k) of directions with i <= k.
  static constexpr int kPairs = kDim * (kDim + 1) / 2;

  const Eigen::MatrixXd* gradients_ = nullptr;
  Eigen::Index n_ = 0, stressRow_ = 0;
  Eigen::MatrixXd g_;  ///< n x columns·Q
  /// kPairs·n + Dim rows x columns·Q: gradients times the weighted moduli, one block per pair (i, k), then
  /// the weighted stresses. Times gᵀ: blocks of the tangent and the forces.
  Eigen::MatrixXd h_;
  Eigen::MatrixXd blocks_;  ///< kPairs·n + Dim x n
};

}  // namespace burnish
