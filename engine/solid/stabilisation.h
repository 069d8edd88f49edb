#pragma once
#include <Eigen/Dense>

#include "engine/solid/span_quadrature.h"
#include "engine/solver/term.h"

namespace burnish::inline solid {

/// A drag that holds a body which only contact holds, until that does. A node a that moves by Δu in a step of
/// length Δt is held back by η(t) m_a Δu / Δt with m_a = ∫ R_a dV; η falls linearly to a small remainder,
/// which keeps the tangent regular in directions that no contact resists. Bodies have viscosities of their own.
template <int Dim>
class Stabilisation final : public Term {
 public:
  struct Drag {
    double start = 0.0;  ///< time of the first state
    double end = 0.0;    ///< > 0: time from which on the remainder is left
  };

  /// Share of the viscosity that is left at the end.
  static constexpr double kRemainder = 1e-3;

  /// numNodes: of all bodies.
  Stabilisation(int numNodes, const Drag& drag);

  /// Holds a body. viscosity: η at the start, stress times time per length².
  void hold(const SpanQuadrature<Dim>& quadrature, double viscosity);

  /// Begins with displacements x instead of none.
  void beginAt(const Eigen::VectorXd& x) { x_ = x.head(x_.size()); }

  CouplingGroups couplings() const override;
  bool evaluate(double t, const Eigen::VectorXd& x, Assembly& out) override;
  void accept() override;
  void archive(StateArchive& archive) override;

  /// Sum of the magnitudes of the drag's components at the nodes, and the work that it takes from the body on
  /// the step that led to the last evaluated state.
  double force() const { return force_; }
  double work() const { return work_; }

 private:
  double viscosity(Eigen::Index node, double t) const;

  Drag drag_;
  Eigen::VectorXd viscosities_;  ///< per node, at the start
  Eigen::VectorXd masses_;       ///< m_a
  Eigen::VectorXd x_;            ///< displacements in the accepted state
  double time_, step_;           ///< of the accepted state and the step that led there
  Eigen::VectorXd trial_;
  double trialTime_;
  double force_ = 0.0, work_ = 0.0;
};

}  // namespace burnish::inline solid
