#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/core/formula.h"
#include "engine/core/schedule.h"
#include "engine/solid/body.h"
#include "engine/solid/face_quadrature.h"
#include "engine/solid/load_term.h"
#include "engine/solid/span_quadrature.h"

namespace burnish::inline solid {

/// A dead load: force per reference area of a face or per reference volume, which does not change with the
/// deformation. Its components are formulas in the reference position and the time.
template <int Dim>
class DeadLoad final : public LoadTerm {
 public:
  /// components: Dim formulas. An empty schedule means a constant factor of 1.
  DeadLoad(const Body<Dim>& body, const FaceQuadrature<Dim>& face, std::vector<Formula> components,
           Schedule factor);

  /// On one patch, or on all if `patch` is negative.
  DeadLoad(const Body<Dim>& body, const SpanQuadrature<Dim>& quadrature, int patch,
           std::vector<Formula> components, Schedule factor);

  CouplingGroups couplings() const override { return {}; }
  bool evaluate(double t, const Eigen::VectorXd& x, Assembly& out) override;
  void requireFinite(const std::vector<double>& times) const override;

 private:
  /// Part of the load on one span.
  struct Span {
    std::vector<int> nodes;
    Eigen::MatrixXd weightedR;  ///< n x Q: basis values times weights
    Eigen::Matrix3Xd X;         ///< reference positions
  };

  Eigen::VectorXd integrate(double t) const;

  std::vector<Span> spans_;
  std::vector<Formula> components_;
  Schedule factor_;
  bool varies_ = false;   ///< whether a component depends on the time
  Eigen::VectorXd unit_;  ///< without the factor, at the time `unitTime_`
  double unitTime_ = 0.0;
};

}  // namespace burnish::inline solid
