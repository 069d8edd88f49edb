#pragma once
#include <Eigen/Dense>
#include <memory>

#include "engine/solid/span_quadrature.h"

namespace burnish::inline fields {

/// L2 projection of quadrature-point fields onto the body's own basis:
/// find q with ∫ R_A (Σ R_B q_B − q) dV = 0 over the reference body. In the plane the mass matrix is
/// factorised once; in space, where factors would need more memory than the computation, conjugate gradients
/// solve with it. Nodes of other bodies get zeros.
template <int Dim>
class Projection {
 public:
  /// The quadrature, made from the body, must outlive the projection.
  Projection(const Body<Dim>& body, const SpanQuadrature<Dim>& quadrature);
  ~Projection();
  Projection(Projection&&) noexcept;

  /// values: points x components; returns nodes x components.
  Eigen::MatrixXd project(const Eigen::MatrixXd& values) const;

 private:
  class Mass;
  const SpanQuadrature<Dim>& quadrature_;
  int firstNode_ = 0;  ///< of the body
  int numNodes_ = 0;   ///< of the body
  std::unique_ptr<Mass> mass_;
};

}  // namespace burnish::inline fields
