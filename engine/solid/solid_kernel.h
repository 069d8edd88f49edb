#pragma once
#include <type_traits>

#include "engine/solid/span_kernel.h"
#include "engine/solid/tensor_kernel.h"

namespace burnish::inline solid {

/// The faster kernel for each span of a solid body. At degree 1 a direction has two functions and two points:
/// sums over one direction at a time save little there and cost more than one product for all points.
class SolidKernel {
 public:
  using Span = TensorKernel::Span;
  using Stress = TensorKernel::Stress;
  using Tangent = TensorKernel::Tangent;

  void start(const Span& span, const Eigen::MatrixXd& gradients, bool wantTangent) {
    isDense_ = span.factors.N[0].rows() == 2;
    isDense_ ? dense_.start(span, gradients, wantTangent) : tensor_.start(span, gradients, wantTangent);
  }
  void setGradients(Eigen::Index q, const Eigen::Matrix3d& F) {
    isDense_ ? dense_.setGradients(q, F) : tensor_.setGradients(q, F);
  }
  void setStress(Eigen::Index q, const Stress& weighted) {
    isDense_ ? dense_.setStress(q, weighted) : tensor_.setStress(q, weighted);
  }
  void setModuli(Eigen::Index q, double w, const Stress& tau, const Tangent& c, double r) {
    isDense_ ? dense_.setModuli(q, w, tau, c, r) : tensor_.setModuli(q, w, tau, c, r);
  }
  void multiply() { isDense_ ? dense_.multiply() : tensor_.multiply(); }
  Eigen::Vector3d force(Eigen::Index a) const { return isDense_ ? dense_.force(a) : tensor_.force(a); }
  const Eigen::MatrixXd& tangent() const { return isDense_ ? dense_.tangent() : tensor_.tangent(); }

 private:
  SpanKernel<Kinematics::Solid> dense_;
  TensorKernel tensor_;
  bool isDense_ = false;
};

/// The kernel for bodies of given kinematics. Symmetric: as their moduli are.
template <Kinematics K, bool Symmetric = true>
using KernelFor =
    std::conditional_t<K == Kinematics::Solid && Symmetric, SolidKernel, SpanKernel<K, Symmetric>>;

}  // namespace burnish::inline solid
