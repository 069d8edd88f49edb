#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "engine/analysis/history_columns.h"
#include "engine/analysis/measures.h"
#include "engine/analysis/model.h"
#include "engine/analysis/reactions.h"
#include "engine/analysis/state_quantities.h"
#include "engine/fields/projection.h"
#include "engine/fields/span_extremes.h"

namespace burnish::inline analysis {

/// Follows a run from state to state: sums the external work, keeps extremes, and makes the history's rows.
template <int Dim>
class RunHistory {
 public:
  /// Scene, model and projections (one per body) must outlive the object.
  RunHistory(const Scene& scene, const Model<Dim>& model, const std::vector<Projection<Dim>>& projections);

  std::vector<std::string> columns() const;

  /// Takes in the accepted state that the terms have just been evaluated at. force: sum of all terms' forces
  /// there; stabilisedShare: see `Model::stabilisedShare`.
  void update(const MeasuredState& state, const Eigen::VectorXd& force, double stabilisedShare);

  /// Goes on with the sums and extremes of a history of the same scene on another mesh.
  void continueFrom(const RunHistory& before);

  /// Tools have just been taken away: what they pressed with counts as loads from here on.
  void noteReleased();

  /// The current state is the first one after the body was meshed anew.
  void noteRezoning(const RezoningRecord& rezoning) { current_.rezonings.add(rezoning); }

  const StateQuantities& current() const { return current_; }

  /// Unknowns of the current state; empty before the first.
  const Eigen::VectorXd& x() const { return x_; }

  /// One value for each column.
  std::vector<double> row(int step, int newtonIterations) const;

  /// States taken in, that at the start among them.
  int numStates() const { return states_; }

  /// Work done on the body beside `externalWork`: of closing gaps after rezonings, less half of that which
  /// loads do that were there at once, as the rest would set the body in motion.
  double otherWork() const { return current_.rezonings.gapWork - suddenWork_; }

  /// Smallest J and largest penetration of all states so far.
  double smallestJ() const { return smallestJ_; }
  double largestPenetration() const { return largestPenetration_; }

  /// Largest share of the forces that the stabilisation has carried.
  double largestStabilisedShare() const { return largestStabilisedShare_; }

  const Reactions<Dim>& reactions() const { return reactions_; }

  /// Extremes of the projected von Mises stress in the current state, which the terms have been evaluated at.
  Extremes projectedVonMises() const;

  /// All that later rows and the end of the run depend on.
  void archive(StateArchive& archive);

  /// Seconds spent in projections.
  double projectionSeconds() const { return projectionSeconds_; }

 private:
  double workIncrement(const Eigen::VectorXd& x, const Eigen::VectorXd& force,
                       const Eigen::VectorXd& loads) const;
  double toolWork(const StateQuantities& next) const;
  double fittingWork(const StateQuantities& next) const;
  void addTools(const MeasuredState& state, StateQuantities& next) const;
  void addPairs(StateQuantities& next) const;
  void addSelfContacts(StateQuantities& next) const;
  void addBodies(StateQuantities& next);
  Eigen::VectorXd loadForces() const;

  const Model<Dim>& model_;
  bool startsWithStress_;  ///< whose energy counts as work done before the run
  const std::vector<Projection<Dim>>& projections_;
  std::vector<SpanExtremes<Dim>> extremes_;  ///< one per body
  Measures<Dim> measures_;
  Reactions<Dim> reactions_;
  std::vector<HistoryColumn> columns_;
  StateQuantities current_;
  Eigen::VectorXd x_, force_, loads_;  ///< of the last state; empty before the first
  double smallestJ_ = 1.0;
  double largestPenetration_ = 0.0;
  double largestStabilisedShare_ = 0.0;
  int states_ = 0;
  double suddenWork_ = 0.0;  ///< half of the work on the first step of loads that were there from the start
  double projectionSeconds_ = 0.0;
};

}  // namespace burnish::inline analysis
