#pragma once
#include "engine/solid/bulk_term.h"

namespace burnish::inline solid {

/// The pure displacement formulation: δΠ = ∫ P : ∇_X δu dV with the consistent tangent.
template <int Dim>
class DisplacementTerm final : public BulkTerm<Dim> {
 public:
  /// reference: none for a stress-free one that has not flowed. The quadrature must outlive the term.
  DisplacementTerm(const SpanQuadrature<Dim>& quadrature, Material material,
                   const std::optional<ReferenceState>& reference = {});

  bool evaluate(double t, const Eigen::VectorXd& x, Assembly& out) override;

 private:
  template <Kinematics K, bool Symmetric>
  struct Workspace;

  template <Kinematics K, class Law>
  bool evaluateAll(PointsOf<Law>& points, const Eigen::VectorXd& x, Assembly& out);
  template <Kinematics K, class Law, class Work>
  bool evaluateSpan(PointsOf<Law>& points, std::size_t number, const Eigen::VectorXd& x, Assembly& out,
                    Work& work);
};

}  // namespace burnish::inline solid
