#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/analysis/doubt_watch.h"
#include "engine/analysis/run_history.h"

namespace burnish::inline analysis {

/// What is to be known of how the forces of an accepted state balance.
struct Equilibrium {
  /// See `Inertia`; counted when it is called.
  std::function<int()> unstableDirections = [] { return 0; };
  double stabilisedShare = 0.0;  ///< see `Model::stabilisedShare`
};

/// What a run remembers of its states: its history, and what makes its results doubtful.
template <int Dim>
class Recorder {
 public:
  /// Scene, model and projections (one per body) must outlive the recorder.
  Recorder(const Scene& scene, const Model<Dim>& model, const std::vector<Projection<Dim>>& projections)
      : history_(scene, model, projections), doubts_(scene, model) {}

  /// Takes in the accepted state that the terms have just been evaluated at. `force`: sum of all terms'
  /// forces there.
  void update(const MeasuredState& state, const Eigen::VectorXd& force, const Equilibrium& equilibrium);

  /// Goes on with the sums and extremes of a recorder of the same scene on another mesh.
  void continueFrom(const Recorder& before);

  /// The run ends with the current state.
  void noteEnd() { doubts_.noteEnd(history_); }

  /// The current state is the first one after the body was meshed anew.
  void noteRezoning(const RezoningRecord& rezoning) { history_.noteRezoning(rezoning); }

  /// Supports or tools have let go in the current state.
  void noteReleased() { history_.noteReleased(); }

  /// A new mesh was due, and none was found.
  void noteFailedRezoning() { doubts_.noteFailedRezoning(); }

  /// Of the history: its columns, a row of the current state, and what it says of that and of all states.
  std::vector<std::string> columns() const { return history_.columns(); }
  std::vector<double> row(int step, int newtonIterations) const {
    return history_.row(step, newtonIterations);
  }
  const StateQuantities& current() const { return history_.current(); }
  double smallestJ() const { return history_.smallestJ(); }
  double largestPenetration() const { return history_.largestPenetration(); }
  double largestStabilisedShare() const { return history_.largestStabilisedShare(); }
  Extremes projectedVonMises() const { return history_.projectedVonMises(); }
  const Reactions<Dim>& reactions() const { return history_.reactions(); }
  double projectionSeconds() const { return history_.projectionSeconds(); }

  /// The conditions that held at some time, with how badly; tools that nothing has touched.
  std::vector<DoubtRecord> doubts() const { return doubts_.records(); }
  std::vector<std::string> idleTools() const { return doubts_.idleTools(); }

  /// All that later rows and the end of the run depend on.
  void archive(StateArchive& archive);

 private:
  RunHistory<Dim> history_;
  DoubtWatch<Dim> doubts_;
};

}  // namespace burnish::inline analysis
