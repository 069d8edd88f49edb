#pragma once
#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "engine/solver/newton.h"

namespace burnish::inline solver {

/// One accepted step.
struct StepReport {
  int step = 0;       ///< number, from 1
  double time = 0.0;  ///< at its end
  double size = 0.0;
  NewtonReport newton;  ///< of the accepted attempt
  int iterations = 0;   ///< corrections of all attempts, failed ones included
  int cuts = 0;         ///< cut-backs on the way to this step
};

/// Everything that the next step depends on beside the histories of the terms.
struct SteppingState {
  double time = 0.0;
  Eigen::VectorXd x;              ///< unknowns at `time`
  Eigen::VectorXd lastIncrement;  ///< of the last step; empty: nothing to extrapolate from
  double lastSize = 0.0;
  int level = 0;                 ///< current step: nominal / 2^level
  int easySteps = 0;             ///< in a row
  int stepsToExtrapolation = 0;  ///< steps that still start from the old state after extrapolation failed
  bool travels = false;          ///< the next increment is the last one, moved (`Stepping::Travel`)
  int steps = 0;
  int cuts = 0;
  long iterations = 0;
  double smallestStep = 0.0;

  void archive(StateArchive& archive);
};

/// How a walk to a time ended.
enum class Walk {
  Arrived,
  Failed,  ///< the smallest step failed; the last accepted state is the current one
  Halted   ///< the caller wanted no further step
};

/// Walks through time in steps that adapt: cut back when Newton fails, grown again after easy steps.
class Stepping {
 public:
  /// Turns the increment of a step that began at `before` into one to begin the next step with, which ends at `to`,
  /// before it is scaled by their lengths. It is used as long as it would have been much nearer than the increment
  /// itself in the step before.
  using Travel = std::function<void(double before, double to, Eigen::VectorXd& increment)>;

  /// `target(t)`: values of the prescribed unknowns at time t (other entries are ignored).
  Stepping(Newton& newton, std::vector<Term*> terms, std::function<Eigen::VectorXd(double)> target,
           SteppingOptions options, SteppingState start, Travel travel = {});

  /// Steps to exactly `time` with steps of at most `nominal`; `accepted` is called after every step and says
  /// whether to go on.
  Walk advance(double time, double nominal, const std::function<bool(const StepReport&)>& accepted);

  /// Brings the unknowns into equilibrium at the current time; the state and the histories are changed only
  /// if that converges.
  NewtonReport settle();

  /// The state; for the histories of the terms and Newton's tangent see there.
  void archive(StateArchive& archive) { state_.archive(archive); }

  /// To be called at a corner of a schedule, where the last increment says nothing about the next one.
  void forgetIncrement() { state_.lastIncrement.resize(0); }

  const SteppingState& state() const { return state_; }

  /// The last failed attempt and its step, for messages.
  const NewtonReport& lastFailure() const { return lastFailure_; }
  double lastFailedStep() const { return lastFailedStep_; }

 private:
  /// How an attempt at a step begins.
  enum class Start { Extrapolated, RememberedTangent, Old };

  /// Ways to begin the next step, the most promising first.
  std::vector<Start> starts() const;

  NewtonReport attempt(double time, Start start, Eigen::VectorXd& x);

  /// Whether the last increment, moved, comes much nearer to that of a step, which has just led to x, than as it is.
  bool travelled(double time, const Eigen::VectorXd& x) const;

  /// The last increment, moved for a step to a time or as it is.
  Eigen::VectorXd lastIncrement(double time, bool moved) const;

  Newton& newton_;
  std::vector<Term*> terms_;
  std::function<Eigen::VectorXd(double)> target_;
  Travel travel_;  ///< empty: increments go on as they are
  SteppingOptions options_;
  SteppingState state_;
  NewtonReport lastFailure_;
  double lastFailedStep_ = 0.0;
};

}  // namespace burnish::inline solver
