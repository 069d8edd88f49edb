#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/recorder.h"
#include "engine/core/state_archive.h"
#include "engine/results/summary_file.h"

namespace burnish {

/// Seconds by part of the program.
struct RunTimings {
  double assembly = 0.0;  ///< body and loads
  double contact = 0.0;
  double factorisation = 0.0;
  double solve = 0.0;
  double projection = 0.0;
  double output = 0.0;  ///< result files and what observers do with a frame
  double total = 0.0;

  void archive(StateArchive& archive);
};

/// What a run says about itself at its end.
struct RunSummary {
  bool completed = false;
  bool halted = false;         ///< because the caller wanted it
  std::string stoppedBecause;  ///< empty when completed
  std::string advice;          ///< what usually helps; empty when completed or halted
  std::string program;         ///< see `programName()`
  int functions = 0;           ///< basis functions of the body
  int unknowns = 0;
  int approachSteps = 0;  ///< that brought lifted tools down before t = 0
  long approachIterations = 0;
  int steps = 0;  ///< from t = 0 on
  int cuts = 0;
  double smallestStep = 0.0;
  long iterations = 0;
  double meanIterations = 0.0;  ///< per step
  int maxIterations = 0;        ///< of one step
  double tolerance = 0.0;
  double constraintTolerance = 0.0;
  double worstResidual = 0.0;     ///< relative, of all accepted steps
  double worstConstraint = 0.0;   ///< averaged gap over the body's size, of all accepted steps
  int stepsAtRoundOff = 0;        ///< steps that ended above the tolerance because rounding allows no less
  double contactParameter = 0.0;  ///< ε of the first contact pair, 0 without contact
  StateQuantities end;            ///< the last state
  std::optional<Extremes> endVonMises;  ///< of the projected stress there; of a run that came to its end
  double smallestJ = 1.0;
  double largestPenetration = 0.0;
  bool stabilised = false;                ///< by `stabilise`
  double largestStabilisedShare = 0.0;    ///< of the largest force
  std::vector<DoubtRecord> doubts;        ///< those that held, in the order of their first times
  std::vector<std::string> warnings;      ///< of the scene, with their keys
  std::vector<ReactionRecord> reactions;  ///< one per support
  std::vector<std::string> idleTools;     ///< with contact pairs, but never in touch
  std::vector<RezoningRecord> rezonings;
  int failedRezonings = 0;      ///< that found no sound mesh or no equilibrium on it
  std::string rezoningFailure;  ///< why the last of them failed
  int frames = 0;
  RunTimings timings;
  long factorNonZeros = 0;
  long luFactorisations = 0;  ///< of tangents that were not definite, see `DirectSolver`

  /// What is counted and timed from step to step.
  void archive(StateArchive& archive);
};

/// The summary under the names of docs/results.md.
SummaryRecord makeSummaryRecord(const RunSummary& summary);

}  // namespace burnish
