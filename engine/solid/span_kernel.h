#pragma once
#include <Eigen/Dense>
#include <array>
#include <cstring>
#include <vector>

#include "engine/core/lanes.h"
#include "engine/core/small_product.h"
#include "engine/solid/kinematics.h"
#include "engine/solid/span_quadrature.h"

namespace burnish::inline solid {

/// c_ijkl + δ_ik τ_jl between gradient columns j of component i and l of component k.
template <Kinematics K, class Stress, class Tangent>
double modulus(int i, int j, int k, int l, const Stress& tau, const Tangent& c) {
  const int first = gradientPlace<K>(i, j), second = gradientPlace<K>(k, l);
  if (first < 0 || second < 0) return 0.0;
  // Axisymmetry: τ has no component that couples the plane with the third direction.
  if (K == Kinematics::Axisymmetric && (j == 2) != (l == 2)) return c(first, second);
  return c(first, second) + (i == k ? tau(voigtPlace(j, l)) : 0.0);
}

/// Forces and tangent of one span, Σ_q g τ and Σ_q g (c + δτ) gᵀ, by matrix products over all its quadrature
/// points. The current gradients g = G P are not formed: stresses and moduli are pulled back to the reference
/// gradients G, P τ and P (c + δτ) Pᵀ. Buffers keep their memory from span to span.
///
/// Symmetric: c is, and half of the tangent is computed.
template <Kinematics K, bool Symmetric = true>
class SpanKernel {
 public:
  static constexpr int kDim = kDimOf<K>;
  using Stress = Eigen::Vector<double, kVoigt<kDim>>;
  using Tangent = Eigen::Matrix<double, kVoigt<kDim>, kVoigt<kDim>>;

  /// Begins a span; its gradients must outlive the work on it.
  void start(const typename SpanQuadrature<kDim>::Span& span, const Eigen::MatrixXd& gradients,
             bool wantTangent) {
    gradients_ = &gradients;
    wantTangent_ = wantTangent;
    const Eigen::Index n = gradients.rows(), depth = kC * span.weights.size();
    if (stress_.cols() != depth) stress_.setZero(kStressRows, depth);
    if (!wantTangent || (tangent_.cols() == kDim * n && h_.cols() == depth)) return;
    moduli_.resize(static_cast<std::size_t>(span.weights.size()));
    h_.setZero(roundedToLanes(n), depth);
    block_.resize(h_.rows(), n);
    tangent_.resize(kDim * n, kDim * n);
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
    stress_.template block<kDim, kC>(0, kC * q) = tau.lazyProduct(pushForward_.transpose());
  }

  /// Moduli of D : c : D + (D τ) : D + r tr(D D), with D the spatial gradient, times the weight w.
  void setModuli(Eigen::Index q, double w, const Stress& tau, const Tangent& c, double r) {
    std::size_t pair = 0;
    for (int i = 0; i < kDim; ++i)
      for (int k = Symmetric ? i : 0; k < kDim; ++k, ++pair) {
        Block spatial;
        for (int j = 0; j < kC; ++j)
          for (int l = 0; l < kC; ++l) spatial(j, l) = w * modulus<K>(i, j, k, l, tau, c);
        spatial(k, i) += w * r;
        if (K == Kinematics::Axisymmetric && i == 0 && k == 0) spatial(2, 2) += w * r;
        const Block left = pushForward_.lazyProduct(spatial);
        moduli_[static_cast<std::size_t>(q)][pair] = left.lazyProduct(pushForward_.transpose());
      }
  }

  /// To be called when all points are set.
  void multiply() {
    forces_.resize(kStressRows, gradients_->rows());
    multiplyTransposedSmall(stress_, *gradients_, forces_);
    if (!wantTangent_) return;
    std::size_t pair = 0;
    for (int i = 0; i < kDim; ++i)
      for (int k = Symmetric ? i : 0; k < kDim; ++k, ++pair) {
        multiplyGradients(pair);
        multiplyTransposedSmall(h_, *gradients_, block_,
                                Symmetric && i == k ? ProductPart::Lower : ProductPart::All);
        arrange(i, k);
      }
  }

  /// Force on function a.
  Eigen::Vector<double, kDim> force(Eigen::Index a) const { return forces_.col(a).template head<kDim>(); }

  /// Dim·n x Dim·n, node by node.
  const Eigen::MatrixXd& tangent() const { return tangent_; }

 private:
  static constexpr int kC = kColumns<K>;
  /// Pairs (i, k) of directions, with i <= k if that is all that has to be known.
  static constexpr int kPairs = Symmetric ? kDim * (kDim + 1) / 2 : kDim * kDim;
  static constexpr int kStressRows = roundedToLanes(kDim);
  using Block = Eigen::Matrix<double, kC, kC>;

  /// Gradients times the moduli of a pair of directions.
  void multiplyGradients(std::size_t pair) {
    const Eigen::Index n = gradients_->rows(), rows = h_.rows();
    const double* G = gradients_->data();
    double* H = h_.data();
    for (const auto& moduli : moduli_) {
      const Block M = moduli[pair];
      Eigen::Index a = 0;
      for (; a + kLanes <= n; a += kLanes) multiplyGradients<Lanes>(G + a, n, M, H + a, rows);
      for (; a < n; ++a) multiplyGradients<double>(G + a, n, M, H + a, rows);
      G += kC * n;
      H += kC * rows;
    }
  }

  /// The same at one point, of one function, or of as many as there are lanes. Strides are those from column to
  /// column.
  template <class Number>
  static void multiplyGradients(const double* G, Eigen::Index strideG, const Block& M, double* H,
                                Eigen::Index strideH) {
    std::array<Number, kC> g;
    for (int j = 0; j < kC; ++j)
      std::memcpy(&g[static_cast<std::size_t>(j)], G + strideG * j, sizeof(Number));
    for (int l = 0; l < kC; ++l) {
      Number sum = g[0] * M(0, l);
      for (int j = 1; j < kC; ++j) sum += g[static_cast<std::size_t>(j)] * M(j, l);
      std::memcpy(H + strideH * l, &sum, sizeof(Number));
    }
  }

  /// Writes the block of a pair of directions into the tangent. Of equal directions it is known from the diagonal
  /// on down.
  void arrange(int i, int k) {
    const Eigen::Index n = gradients_->rows();
    for (Eigen::Index b = 0; b < n; ++b) {
      const double* from = &block_(0, b);
      double* entries = &tangent_(i, kDim * b + k);
      if (!Symmetric) {
        for (Eigen::Index a = 0; a < n; ++a) entries[kDim * a] = from[a];
        continue;
      }
      double* mirrored = &tangent_(kDim * b + k, i);
      for (Eigen::Index a = i == k ? b : 0; a < n; ++a)
        entries[kDim * a] = mirrored[kDim * kDim * n * a] = from[a];
    }
  }

  const Eigen::MatrixXd* gradients_ = nullptr;
  bool wantTangent_ = false;
  Block pushForward_;       ///< P at the point that is being set
  Eigen::MatrixXd stress_;  ///< Dim rows, and some of lanes without use, x columns·Q: weighted, P τ
  Eigen::MatrixXd forces_;  ///< as many rows x n
  std::vector<std::array<Block, kPairs>> moduli_;  ///< per point: weighted, P (c + δτ) Pᵀ
  Eigen::MatrixXd h_;        ///< n rows, and some of zeros, x columns·Q: G times the moduli of a pair
  Eigen::MatrixXd block_;    ///< as many rows x n: `h_` times Gᵀ
  Eigen::MatrixXd tangent_;  ///< Dim·n x Dim·n
};

}  // namespace burnish::inline solid
