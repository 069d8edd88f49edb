#pragma once
#include <Eigen/Dense>
#include <array>

#include "engine/material/response.h"
#include "engine/solid/span_quadrature.h"

namespace burnish::inline solid {

/// Forces and tangent of one span of a solid body: what `SpanKernel` makes, with the sums over the quadrature
/// points taken one direction after the other.
///
/// The block (i, k) of the tangent is w_a w_b Σ_q Σ_mn D_m N_a M_mn D_n N_b, where M holds the moduli and the
/// map's derivatives, and D_m N is a product of univariate functions of which the one in direction m is
/// differentiated (none for m = 3). At degree p a span takes of the order of p^7 operations instead of p^9.
class TensorKernel {
 public:
  using Span = SpanQuadrature<3>::Span;
  using Stress = MaterialResponse<3>::Stress;
  using Tangent = MaterialResponse<3>::Tangent;

  /// Begins a span, which must outlive the work on it, as its gradients must.
  void start(const Span& span, const Eigen::MatrixXd& gradients, bool wantTangent);

  /// Sets the gradients at point q from the deformation gradient; to be called before the stress and the
  /// moduli of the same point are set.
  void setGradients(Eigen::Index q, const Eigen::Matrix3d& F);

  /// Stress that makes the forces, times the weight.
  void setStress(Eigen::Index q, const Stress& weighted);

  /// Moduli of D : c : D + (D τ) : D + r tr(D D), with D the spatial gradient, times the weight w.
  void setModuli(Eigen::Index q, double w, const Stress& tau, const Tangent& c, double r);

  /// To be called when all points are set.
  void multiply();

  /// Force on function a.
  Eigen::Vector3d force(Eigen::Index a) const { return forces_.row(a); }

  /// 3·n x 3·n, node by node.
  const Eigen::MatrixXd& tangent() const { return tangent_; }

 private:
  /// Pairs (i, k) of directions with i <= k.
  static constexpr int kPairs = 6;

  void makeProducts();
  void sumOverPoints();
  void arrange();
  template <int First>
  void arrangeFor();

  const Span* span_ = nullptr;
  const Eigen::MatrixXd* gradients_ = nullptr;
  bool wantTangent_ = false;
  Eigen::Index points_ = 0;  ///< per direction
  Eigen::Matrix3d Finv_;     ///< at the point that is being set
  Eigen::MatrixXd stress_;   ///< 3·Q x 3: per point F⁻¹ τ w
  Eigen::MatrixXd forces_;   ///< n x 3
  std::array<Eigen::MatrixXd, 3>
      products_;  ///< per direction (p+1)² x 4·points: pairs of univariate functions
  /// Sums over none of the directions (kPairs x 16·Q), then over one more with every stage.
  std::array<Eigen::VectorXd, 4> sums_;
  Eigen::MatrixXd tangent_;  ///< 3·n x 3·n
};

}  // namespace burnish::inline solid
