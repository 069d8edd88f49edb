#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/shares.h"
#include "engine/material/material_points.h"
#include "engine/solid/body.h"
#include "engine/solid/formulation.h"
#include "engine/solid/parallel_spans.h"
#include "engine/solid/reference_state.h"
#include "engine/solid/span_quadrature.h"
#include "engine/solver/term.h"

namespace burnish::inline solid {

/// Sums and extremes over the body at the last evaluated state.
struct BulkSummary {
  double strainEnergy = 0.0;
  double plasticWorkIncrement = 0.0;  ///< since the last accepted state
  double minJ = std::numeric_limits<double>::infinity();
};

/// The body's resistance, total Lagrangian: history and stresses at the quadrature points, which all
/// formulations share. Each of several ranks works on the spans that touch its unknowns, keeps what is known of
/// their points alone, and is handed forces and sums by the others with every evaluation. Spans next to the
/// border of a rank's unknowns are worked on by both sides, which find the same bits.
template <int Dim>
class BulkTerm : public Term {
 public:
  using Stress = Eigen::Vector<double, kVoigt<Dim>>;

  CouplingGroups couplings() const override { return groups_; }
  void divideAmong(const Team& team, const Division& division) override;
  bool hasSymmetricTangent() const override { return points_.hasSymmetricTangent(); }
  void accept() override;
  void archive(StateArchive& archive) override;

  const BulkSummary& summary() const { return summary_; }

  /// Spans that this rank works on.
  int numWorkedOn() const { return static_cast<int>(workedOn().size()); }

  /// Dissipated by plastic flow up to the last accepted state.
  double plasticWork() const { return plasticWork_; }

  /// The quadrature points that this rank works on, of all of the body.
  const Portion& portion() const { return points_.portion(); }

  /// The law with its accepted states, one per quadrature point of the portion.
  const MaterialPoints& points() const { return points_; }

  /// Kirchhoff stress τ = J σ (components of `kVoigt`) and J = det F V_e at the portion's points in the last
  /// evaluated state, with σ the Cauchy stress that the law answers.
  const std::vector<Stress>& kirchhoffStress() const { return stress_; }
  const std::vector<double>& jacobians() const { return J_; }

  Material material() const { return points_.material(); }

  /// Weights of the portion's points by stress-free volume.
  const Eigen::VectorXd& weights() const { return weights_; }

  /// What goes along to a new reference configuration: the accepted state with displacements x, of all of the body. To be
  /// called by all ranks.
  PointStates carried(const Eigen::VectorXd& x) const;

  /// Of all of the body. To be called by all ranks.
  double stressFreeVolume() const;

  /// Largest principal stretch since the reference configuration, over the portion's points.
  double largestStretch(const Eigen::VectorXd& x) const;

 protected:
  /// reference: none for a stress-free one that has not flowed. The quadrature must outlive the term.
  BulkTerm(const SpanQuadrature<Dim>& quadrature, Material material,
           const std::optional<ReferenceState>& reference = {});

  /// F V_e at a point, F F₀^{-1} V_e where the reference state has an F₀.
  Eigen::Matrix3d elasticGradient(std::size_t point, const Eigen::Matrix3d& F) const {
    return stretch_.empty() ? F : Eigen::Matrix3d(F * stretch_[point]);
  }

  /// det V_e at a point, det F₀^{-1} V_e.
  double referenceVolumeRatio(std::size_t point) const {
    return stretch_.empty() ? 1.0 : stretch_[point].determinant();
  }

  /// The deformation gradients that the law sees at the portion's points, with displacements x. To be called by all ranks.
  virtual std::vector<Eigen::Matrix3d> gradientsOfLaw(const Eigen::VectorXd& x) const;

  /// Evaluates the law at one point from its accepted state and adds to the span's summary; false if it
  /// cannot answer. Stress and J are stored by the formulation.
  template <class Law>
  bool respond(PointsOf<Law>& points, std::size_t point, double weight, const Eigen::Matrix3d& F,
               MaterialResponse<Dim>& response, BulkSummary& summary) {
    if (!points.template evaluate<Dim>(point, F, response)) return false;
    // Written as fused operations, so that no choice of the compiler decides the last digit.
    summary.strainEnergy = std::fma(weight, response.strainEnergy, summary.strainEnergy);
    summary.plasticWorkIncrement = std::fma(weight, response.plasticWork, summary.plasticWorkIncrement);
    return true;
  }

  /// Adds forces and, if wanted, the tangent of a span.
  template <class Kernel>
  void add(const Kernel& kernel, std::size_t number, Assembly& out) const {
    const auto& nodes = quadrature_.spans()[number].nodes;
    const auto n = static_cast<Eigen::Index>(nodes.size());
    for (Eigen::Index a = 0; a < n; ++a)
      out.force.segment<Dim>(Dim * nodes[static_cast<std::size_t>(a)]) += kernel.force(a);
    if (out.system != nullptr) out.system->add(out.term, number, kernel.tangent());
  }

  /// Where the points of a span begin among those of the portion.
  int firstPoint(std::size_t span) const { return firstPoints_[span]; }
  std::span<const int> firstPoints() const { return firstPoints_; }

  /// Numbers of the spans that this rank works on, and of those among them that are its own, of no other rank.
  std::vector<int> workedOn() const;
  std::span<const int> own() const;

  /// Whether all ranks have found their spans admissible.
  bool allRanks(bool admissible) const { return team_->all(admissible); }

  /// To be called at the end of an evaluation in which all spans that this rank works on were admissible or not:
  /// has of other ranks what is theirs and makes the summary of the body. Returns whether all are admissible.
  bool conclude(bool admissible, Assembly& out);

  const SpanQuadrature<Dim>& quadrature_;
  MaterialPoints points_;
  CouplingGroups groups_;  ///< unknowns of each span
  /// Batches of spans by colour: those of one colour have no unknown in common.
  std::vector<SpanBatches> colours_;
  Eigen::VectorXd weights_;
  std::vector<Stress> stress_;
  std::vector<double> J_;
  std::vector<BulkSummary> spanSummaries_;

 private:
  /// Whether a span touches an unknown that this rank answers for.
  bool touchesOwn(std::size_t span) const;

  /// Makes the summary of the body from those of the spans.
  void summarise();

  std::vector<Eigen::Matrix3d> stretch_;  ///< F₀^{-1} V_e of the reference state; empty: one everywhere
  BulkSummary summary_;
  double plasticWork_ = 0.0;

  const Team* team_ = &alone();
  Division division_;
  Shares shareOfSpans_;           ///< empty for one rank
  std::vector<int> firstPoints_;  ///< per span; -1 where it is left to other ranks
};

/// Displacement unknowns of nodes, node by node.
template <int Dim>
std::vector<int> unknownsOf(const std::vector<int>& nodes);

/// The bulk term of a body in the given formulation. reference: none for a stress-free one that has not
/// flowed. The quadrature, made from the same body, must outlive the term.
template <int Dim>
std::unique_ptr<BulkTerm<Dim>> makeBulkTerm(const Body<Dim>& body, const SpanQuadrature<Dim>& quadrature,
                                            Material material, Formulation formulation,
                                            const std::optional<ReferenceState>& reference = {});

}  // namespace burnish::inline solid
