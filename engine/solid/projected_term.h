#pragma once
#include <optional>
#include <vector>

#include "engine/solid/bulk_term.h"
#include "engine/solid/dilatation_coupling.h"
#include "engine/solid/dilatation_projection.h"

namespace burnish::inline solid {

/// The F-bar formulation in its variational form: the law sees F̄ = (J̄/J)^{1/m} F V_e with J = det F V_e and
/// J̄ = Π J, where m counts the directions in which the volume can change (2 in plane strain, else 3), and
///
///     δΠ = Σ w [ (τ̄ − p 1) : ∇δu + p δJ̄/J̄ ],   p = tr τ̄ / m − φ'(d)
///
/// follows from the energy of the law at F̄ and φ(d) = μ/4 d⁴, d = ln(J/J̄), so that the tangent is
/// symmetric if that of the law is; w are stress-free volumes. Without φ nothing but the resistance to shear, which plastic flow
/// takes away, would keep J within a span from going to zero where J̄ stays near one: free surfaces would
/// fold up. It is of fourth order, so that the changes of a few percent that a mesh needs in order not to
/// lock cost next to nothing. History is that at F̄, the energy contains φ, `jacobians()` are J, and σ =
/// τ̄/J̄. A reference state made from `carried` has the volume J̄: there d begins anew at zero.
template <int Dim>
class ProjectedTerm final : public BulkTerm<Dim> {
 public:
  /// The quadrature, made from the same body, must outlive the term.
  ProjectedTerm(const Body<Dim>& body, const SpanQuadrature<Dim>& quadrature, Material material,
                const std::optional<ReferenceState>& reference = {});

  CouplingGroups couplings() const override;
  void keepProducts() override;
  void divideAmong(const Team& team, const Division& division) override;

  bool evaluate(double t, const Eigen::VectorXd& x, Assembly& out) override;

 protected:
  std::vector<Eigen::Matrix3d> gradientsOfLaw(const Eigen::VectorXd& x) const override;

 private:
  template <Kinematics K>
  struct Workspace;

  ProjectedTerm(const SpanQuadrature<Dim>& quadrature, Material material,
                const std::optional<ReferenceState>& reference, DilatationProjection<Dim> projection);

  template <Kinematics K>
  bool evaluateAll(const Eigen::VectorXd& x, Assembly& out);
  template <Kinematics K>
  bool measure(std::size_t number, const Eigen::VectorXd& x, bool wantTangent, Workspace<K>& work);
  template <Kinematics K, class Law>
  bool respondOnSpan(PointsOf<Law>& points, std::size_t number);
  template <Kinematics K, bool Symmetric>
  void assemble(std::size_t number, Assembly& out, Workspace<K>& work);
  void gatherPressure();

  DilatationProjection<Dim> projection_;
  std::vector<DilatationShare> shares_;              ///< of spans, in the last tangent
  std::optional<DilatationCoupling<Dim>> coupling_;  ///< none before a tangent is asked for
  std::optional<DilatationProduct<Dim>> product_;    ///< none where the tangent has all entries
  double shearModulus_;

  // The last evaluated state, at the portion's quadrature points, …
  std::vector<Eigen::Matrix3d> F_;
  std::vector<MaterialResponse<Dim>> responses_;
  Eigen::VectorXd Jbar_;
  Eigen::VectorXd stressOnJbar_;  ///< p, of the last evaluated state
  // … as coefficients of Π's functions, …
  Eigen::VectorXd dilatation_;  ///< J̄ − 1
  Eigen::VectorXd pressure_;    ///< Σ N w p/J̄
  // … and of spans.
  std::vector<Eigen::VectorXd> spanDilatations_;  ///< share of the span in `dilatation_`
};

}  // namespace burnish::inline solid
