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
/// quadrature points. The current gradients g = G P are not formed: stresses and moduli are pulled back to the
/// reference gradients G, P τ and P (c + δτ) Pᵀ. Buffers keep their memory from span to span.
template <Kinematics K>
class SpanKernel {
 public:
  static constexpr int kDim = kDimOf<K>;
  using Stress = Eigen::Vector<double, kVoigt<kDim>>;
  using Tangent = Eigen::Matrix<double, kVoigt<kDim>, kVoigt<kDim>>;

  /// Begins a span, which must outlive the work on it.
  void start(const typename SpanQuadrature<kDim>::Span& span, bool wantTangent) {
    span_ = &span;
    const Eigen::Index n = span.G.rows(), Q = span.weights.size();
    n_ = n;
    stressRow_ = wantTangent ? kPairs * n : 0;
    h_.resize(stressRow_ + kDim, kC * Q);
  }

  /// Sets the gradients at point q from the deformation gradient; to be called before the stress and the
  /// moduli of the same point are set.
  void setGradients(Eigen::Index, const Eigen::Matrix3d& F) { pushForward_ = pushForward<K>(F); }

  /// Stress that makes the forces, times the weight.
  void setStress(Eigen::Index q, const Stress& weighted) {
    Eigen::Matrix<double, kDim, kC> tau;
    for (int i = 0; i < kDim; ++i)
      for (int j = 0; j < kC; ++j)
        tau(i, j) = gradientPlace<K>(i, j) < 0 ? 0.0 : weighted(gradientPlace<K>(i, j));
    h_.template block<kDim, kC>(stressRow_, kC * q) = tau.lazyProduct(pushForward_.transpose());
  }

  /// Moduli of D : c : D + (D τ) : D + r tr(D D), with D the spatial gradient, times the weight w.
  void setModuli(Eigen::Index q, double w, const Stress& tau, const Tangent& c, double r) {
    const auto G = span_->G.template middleCols<kC>(kC * q);
    Eigen::Index pair = 0;
    for (int i = 0; i < kDim; ++i)
      for (int k = i; k < kDim; ++k, ++pair) {
        Eigen::Matrix<double, kC, kC> moduli = Eigen::Matrix<double, kC, kC>::Zero();
        for (int j = 0; j < kC; ++j)
          for (int l = 0; l < kC; ++l) moduli(j, l) = w * modulus<K>(i, j, k, l, tau, c);
        moduli(k, i) += w * r;
        if (K == Kinematics::Axisymmetric && k == 0) moduli(2, 2) += w * r;
        const Eigen::Matrix<double, kC, kC> left = pushForward_.lazyProduct(moduli);
        moduli = left.lazyProduct(pushForward_.transpose());
        for (int l = 0; l < kC; ++l) h_.col(kC * q + l).segment(pair * n_, n_) = G.lazyProduct(moduli.col(l));
      }
  }

  /// To be called when all points are set.
  void multiply() {
    multiplyTransposed(h_, span_->G, blocks_);
    if (stressRow_ > 0) arrange();
  }

  /// Force on function a.
  Eigen::Vector<double, kDim> force(Eigen::Index a) const {
    return blocks_.col(a).template segment<kDim>(stressRow_);
  }

  /// Dim·n x Dim·n, node by node.
  const Eigen::MatrixXd& tangent() const { return tangent_; }

 private:
  static constexpr int kC = kColumns<K>;
  /// Pairs (i, k) of directions with i <= k.
  static constexpr int kPairs = kDim * (kDim + 1) / 2;

  /// The tangent from the blocks of pairs.
  void arrange() {
    tangent_.resize(kDim * n_, kDim * n_);
    for (Eigen::Index b = 0; b < n_; ++b) {
      const double* pair = &blocks_(0, b);
      for (int i = 0; i < kDim; ++i)
        for (int k = i; k < kDim; ++k, pair += n_) {
          double* to = &tangent_(i, kDim * b + k);
          for (Eigen::Index a = 0; a < n_; ++a) to[kDim * a] = pair[a];
          if (i == k) continue;
          double* mirrored = &tangent_(kDim * b + k, i);
          for (Eigen::Index a = 0; a < n_; ++a) mirrored[kDim * kDim * n_ * a] = pair[a];
        }
    }
  }

  const typename SpanQuadrature<kDim>::Span* span_ = nullptr;
  Eigen::Index n_ = 0, stressRow_ = 0;
  Eigen::Matrix<double, kC, kC> pushForward_;  ///< P at the point that is being set
  /// kPairs·n + Dim rows x columns·Q: gradients times the weighted moduli, one block per pair (i, k), then
  /// the weighted stresses. Times Gᵀ: blocks of the tangent and the forces.
  Eigen::MatrixXd h_;
  Eigen::MatrixXd blocks_;   ///< kPairs·n + Dim x n
  Eigen::MatrixXd tangent_;  ///< Dim·n x Dim·n
};

}  // namespace burnish
