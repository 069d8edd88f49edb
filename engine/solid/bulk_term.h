#pragma once
#include <Eigen/Dense>
#include <limits>
#include <vector>

#include "engine/material/material.h"
#include "engine/solid/body.h"
#include "engine/solid/span_quadrature.h"
#include "engine/solver/term.h"

namespace burnish {

/// Sums and extremes over the body at the last evaluated state.
struct BulkSummary {
  double strainEnergy = 0.0;
  double plasticWorkIncrement = 0.0;  ///< since the last accepted state
  double maxPlasticStrain = 0.0;      ///< over quadrature points
  double minJ = std::numeric_limits<double>::infinity();
};

/// The body's resistance, total Lagrangian: δΠ = ∫ P : ∇_X δu dV with the consistent tangent.
template <int Dim>
class BulkTerm final : public Term {
 public:
  using Stress = Eigen::Vector<double, kVoigt<Dim>>;

  /// The quadrature must outlive the term.
  BulkTerm(const SpanQuadrature<Dim>& quadrature, Material material);

  CouplingGroups couplings() const override { return groups_; }
  bool evaluate(double t, const Eigen::VectorXd& x, Assembly& out) override;
  void accept() override;

  const BulkSummary& summary() const { return summary_; }

  /// Dissipated by plastic flow up to the last accepted state.
  double plasticWork() const { return plasticWork_; }

  /// Accepted history, one entry per quadrature point.
  const std::vector<MaterialState>& history() const { return accepted_; }

  /// Kirchhoff stress (components of `kVoigt`) and J at the quadrature points of the last evaluated state.
  const std::vector<Stress>& kirchhoffStress() const { return stress_; }
  const std::vector<double>& jacobians() const { return J_; }

  const Material& material() const { return material_; }

 private:
  struct Workspace;

  template <class Law>
  bool evaluateSpan(const Law& law, std::size_t span, const Eigen::VectorXd& x, Assembly& out,
                    Workspace& work);
  template <class Law>
  bool evaluateAll(const Law& law, const Eigen::VectorXd& x, Assembly& out);

  const SpanQuadrature<Dim>& quadrature_;
  Material material_;
  CouplingGroups groups_;
  std::vector<std::vector<int>> colours_;
  std::vector<MaterialState> accepted_, trial_;
  std::vector<Stress> stress_;
  std::vector<double> J_;
  std::vector<BulkSummary> spanSummaries_;
  BulkSummary summary_;
  double plasticWork_ = 0.0;
};

}  // namespace burnish
