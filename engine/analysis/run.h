#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/analysis/recorder.h"
#include "engine/results/result.h"
#include "engine/scene/scene.h"
#include "engine/solver/newton.h"

namespace burnish {

struct RunOptions {
  int threads = 0;  ///< 0: as many as the machine has; results do not depend on it
};

/// Where a run stands, after every accepted step.
struct RunProgress {
  int step = 0;
  double time = 0.0;
  double endTime = 0.0;
  double stepSize = 0.0;
  int iterations = 0;  ///< of this step, failed attempts included
  int totalCuts = 0;
  double residual = 0.0;  ///< relative, at the end of the step
};

/// Seconds by part of the program.
struct RunTimings {
  double assembly = 0.0;  ///< body and loads
  double contact = 0.0;
  double factorisation = 0.0;
  double solve = 0.0;
  double projection = 0.0;
  double output = 0.0;  ///< result files and what observers do with a frame
  double total = 0.0;
};

/// What a run says about itself at its end.
struct RunSummary {
  bool completed = false;
  std::string stoppedBecause;  ///< empty when completed
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
  double smallestJ = 1.0;
  double largestPenetration = 0.0;
  std::vector<Doubt> doubts;           ///< those that held
  std::vector<std::string> idleTools;  ///< with contact pairs, but never in touch
  int frames = 0;
  RunTimings timings;
  long factorNonZeros = 0;
  long luFactorisations = 0;  ///< of tangents that were not definite, see LinearSolver
};

/// Is told what happens during a run.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  virtual void onStart(const ModelRecord&) {}
  virtual void onStep(const RunProgress&) {}
  virtual void onFrame(const ModelRecord&, const FrameRecord&) {}
};

/// Computes a scene and writes its result set, `history.csv`, `convergence.csv` and, at its end,
/// `summary.yaml` into a directory. A run that cannot reach its end keeps everything computed so far and says
/// why in the summary. Throws `Error` before anything is written if the scene cannot be computed, or when the
/// directory cannot be written.
RunSummary runScene(const Scene& scene, const std::filesystem::path& directory, const RunOptions& options,
                    RunObserver& observer);

}  // namespace burnish
