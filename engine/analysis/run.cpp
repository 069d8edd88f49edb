#include "engine/analysis/run.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "engine/analysis/failure.h"
#include "engine/analysis/frames.h"
#include "engine/analysis/model.h"
#include "engine/analysis/time_grid.h"
#include "engine/core/blas.h"
#include "engine/core/error.h"
#include "engine/core/stopwatch.h"
#include "engine/results/check_records.h"
#include "engine/results/result_reader.h"
#include "engine/results/run_files.h"
#include "engine/scene/reader.h"
#include "engine/solver/stepping.h"

namespace burnish {
namespace {

/// One run of a scene of given dimension.
template <int Dim>
class Run {
 public:
  /// resumes: goes on with the run that was stopped in the directory.
  Run(const Scene& scene, Model<Dim>& model, const std::filesystem::path& directory, bool resumes,
      std::function<bool()> halt, RunObserver& observer)
      : scene_(scene),
        halt_(std::move(halt)),
        observer_(observer),
        model_(model),
        terms_(model_.terms()),
        newton_(terms_, model_.prescribed(), model_.residualScales(), newtonOptions(scene)),
        stepping_(
            newton_, terms_, [this](double t) { return model_.target(t); }, {.maxCuts = scene.solver.maxCuts},
            model_.startState()),
        projection_(model_.quadrature()),
        recorder_(scene, model_, projection_),
        record_(makeModelRecord(scene, model_)),
        directory_(directory),
        files_(directory, record_, recorder_.columns(), resumes) {}

  RunSummary execute() {
    observer_.onStart(record_);
    try {
      end(begin() ? walk() : Walk::Failed);
    } catch (const RunError& error) {
      summary_.stoppedBecause = fmt::format("after t = {:.6g}: {}", stepping_.state().time, error.what());
    }
    fillSummary();
    if (!summary_.halted) files_.finish(makeSummaryRecord(summary_));  // a summary means that a run has ended
    return std::move(summary_);
  }

  /// All that the rest of the run depends on.
  void archive(StateArchive& archive) {
    summary_.timings.total = seconds();
    summary_.factorNonZeros = std::max(summary_.factorNonZeros, newton_.linearSolver().factorNonZeros());
    archive.part("stepping", stepping_);
    archive.part("newton", newton_);
    for (std::size_t k = 0; k < terms_.size(); ++k) archive.part(fmt::format("term{}", k), *terms_[k]);
    archive.part("recorder", recorder_);
    archive.part("summary", summary_);
    archive.field("step", step_);
    archive.field("last_frame_time", lastFrameTime_);
    archive.field("last_row_time", lastRowTime_);
    if (archive.restores()) secondsBefore_ = summary_.timings.total;
  }

 private:
  static NewtonOptions newtonOptions(const Scene& scene) {
    return {.tolerance = scene.solver.tolerance, .maxIterations = scene.solver.maxIterations};
  }

  double seconds() const {
    return secondsBefore_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  /// To the state at t = 0, or to the one in which the run was stopped; false if the way there failed.
  bool begin() {
    if (files_.restart() == nullptr) return approach() == Walk::Arrived;
    restore(*files_.restart());
    return true;
  }

  void restore(const RestartRecord& restart) {
    StateArchive saved(restart.state);
    archive(saved);
    const ResultReader result(directory_);
    for (int k = 0; k < result.numFrames(); ++k) observer_.onFrame(record_, result.frame(k));
  }

  SavedState save() {
    StateArchive saved;
    archive(saved);
    return saved.values();
  }

  struct Forces {
    Eigen::VectorXd bulk, total;
  };

  /// Evaluates the terms at the current state without a step.
  Forces evaluateHere() {
    const auto& state = stepping_.state();
    Forces forces{{}, Eigen::VectorXd::Zero(model_.numUnknowns())};
    for (Term* term : terms_) {
      Eigen::VectorXd force = Eigen::VectorXd::Zero(model_.numUnknowns());
      Assembly out{force};
      static_cast<void>(term->evaluate(state.time, state.x, out));  // an accepted state is admissible
      forces.total += force;
      if (term == terms_.front()) forces.bulk = std::move(force);
    }
    return forces;
  }

  /// Hands the state that a step has just reached to the recorder.
  void record(const StepReport& step) {
    Eigen::VectorXd total = Eigen::VectorXd::Zero(model_.numUnknowns());
    for (std::size_t k = 0; k < terms_.size(); ++k) total += newton_.force(k);
    recorder_.update({step.time, stepping_.state().x, newton_.force(0)}, total);
    if (const std::string pulled = model_.pulledTool(); !pulled.empty())
      throw RunError(
          fmt::format("tool '{}' is pulled off the body by the load that it carries; a tool with a "
                      "free way has to be pressed on the body, or its motion prescribed",
                      pulled));
  }

  /// Brings lifted tools down and records the state at t = 0.
  Walk approach() {
    const Forces forces = evaluateHere();
    recorder_.update({stepping_.state().time, stepping_.state().x, forces.bulk}, forces.total);
    for (Term* term : terms_) term->accept();
    Walk walk = Walk::Arrived;
    if (model_.startTime() < 0.0) {
      walk = stepping_.advance(0.0, -0.25 * model_.startTime(), [this](const StepReport& step) {
        record(step);
        noteResiduals(step);
        ++summary_.approachSteps;
        summary_.approachIterations += step.iterations;
        return true;
      });
      stepping_.forgetIncrement();
    }
    append(0, 0);
    if (walk == Walk::Arrived) writeFrame();
    return walk;
  }

  Walk walk() {
    const auto grid = timeGrid(scene_, model_.corners());
    for (const Landing& landing : grid) {
      if (landing.time < stepping_.state().time) continue;  // of a run that is resumed
      const Walk walk = stepping_.advance(landing.time, landing.nominalStep, [&](const StepReport& step) {
        record(step);
        noteResiduals(step);
        summary_.maxIterations = std::max(summary_.maxIterations, step.iterations);
        step_ = step.step - summary_.approachSteps;
        append(step_, step.iterations);
        for (std::size_t k = 0; k < step.newton.history.size(); ++k)
          files_.appendConvergence(
              {static_cast<double>(step_), step.time, static_cast<double>(k), step.newton.history[k]});
        observer_.onStep({step_, step.time, grid.back().time, step.size, step.iterations,
                          stepping_.state().cuts, step.newton.residual});
        halts_ = halt_();
        return !halts_;
      });
      if (walk != Walk::Arrived) return walk;
      if (landing.frame && lastFrameTime_ != landing.time) writeFrame();
      if (landing.corner) stepping_.forgetIncrement();
      if (halts_ && landing.time < grid.back().time) return Walk::Halted;
    }
    return Walk::Arrived;
  }

  void end(Walk walk) {
    summary_.completed = walk == Walk::Arrived;
    summary_.halted = walk == Walk::Halted;
    if (walk == Walk::Failed) {
      noteFailure();
      keepLastState();
    }
    if (walk == Walk::Halted) {
      summary_.stoppedBecause = fmt::format("halted at t = {:.6g}", stepping_.state().time);
      files_.keep(stepping_.state().steps, save());
    }
  }

  void noteResiduals(const StepReport& step) {
    summary_.worstResidual = std::max(summary_.worstResidual, step.newton.residual);
    summary_.worstConstraint = std::max(summary_.worstConstraint, step.newton.constraint);
    summary_.stepsAtRoundOff += step.newton.atRoundOff ? 1 : 0;
  }

  /// The current state as the next frame.
  FrameRecord nextFrame() {
    const auto& state = stepping_.state();
    FrameRecord frame = makeFrame(scene_, model_, projection_, summary_.frames, step_, state.time, state.x);
    try {
      checkFrame(frame, record_, fmt::format("the frame at t = {:.6g}", state.time));
    } catch (const Error& error) {
      throw RunError(error.what());
    }
    ++summary_.frames;
    lastFrameTime_ = state.time;
    return frame;
  }

  void writeFrame() {
    const Stopwatch stopwatch(summary_.timings.output);
    const FrameRecord frame = nextFrame();
    files_.append(frame, stepping_.state().steps, save());
    observer_.onFrame(record_, frame);
  }

  void noteFailure() {
    const auto& state = stepping_.state();
    const NewtonReport& failure = stepping_.lastFailure();
    summary_.stoppedBecause =
        fmt::format("at t = {:.6g} the smallest step ({:.3g}) failed: {} (last relative residual {:.2e})",
                    state.time, stepping_.lastFailedStep(), describe(failure.outcome), failure.residual);
    const Failure found = diagnose(model_, failure);
    summary_.stoppedBecause += "; " + found.findings;
    summary_.advice = found.advice;
    if (const std::string pulled = model_.pulledTool(); !pulled.empty())
      summary_.stoppedBecause += fmt::format(
          "; tool '{}' had lost the body: the load that it carries may have pulled it off, or does not "
          "determine its place",
          pulled);
    if (const std::string way = model_.runawayWay(); !way.empty())
      summary_.stoppedBecause += fmt::format(
          "; {}: the tool would have turned by more than 0.2 radians, or moved by more than the body's size, "
          "in "
          "one step, as too little resists it in this way: leave it out of carry, prescribe it, or place the "
          "tool so that it rests on several control points",
          way);
  }

  void append(int step, int iterations) {
    const std::vector<double> row = recorder_.row(step, iterations);
    for (std::size_t column = 0; column < row.size(); ++column)
      if (!std::isfinite(row[column]))
        throw RunError(fmt::format("{} is not finite at t = {:.6g}", recorder_.columns()[column],
                                   recorder_.current().time));
    files_.appendHistory(row);
    lastRowTime_ = recorder_.current().time;
  }

  /// After a failed step: the last accepted state becomes the last frame, unless it was refused.
  void keepLastState() {
    const double time = stepping_.state().time;
    if (time != lastRowTime_ || (summary_.frames > 0 && time == lastFrameTime_)) return;
    static_cast<void>(evaluateHere());
    const FrameRecord frame = nextFrame();
    files_.appendLast(frame);
    observer_.onFrame(record_, frame);
  }

  void fillSummary() {
    const auto& state = stepping_.state();
    const auto& timings = newton_.timings();
    summary_.timings.total = seconds();
    summary_.program = record_.program;
    summary_.functions = record_.mesh.numNodes;
    summary_.unknowns = static_cast<int>(newton_.system().freeUnknowns().size());
    summary_.steps = step_;
    summary_.cuts = state.cuts;
    summary_.smallestStep = state.smallestStep;
    summary_.iterations = state.iterations - summary_.approachIterations;
    summary_.meanIterations = static_cast<double>(summary_.iterations) / std::max(1, step_);
    summary_.tolerance = scene_.solver.tolerance;
    summary_.constraintTolerance = newtonOptions(scene_).constraintTolerance;
    if (!model_.contacts().empty())
      summary_.contactParameter = model_.contacts().front().term->options().parameter;
    summary_.end = recorder_.current();
    summary_.smallestJ = recorder_.smallestJ();
    summary_.largestPenetration = recorder_.largestPenetration();
    for (const Doubt& doubt : recorder_.doubts())
      if (doubt.steps > 0) summary_.doubts.push_back(doubt);
    summary_.idleTools = recorder_.idleTools();
    for (std::size_t k = 0; k < timings.terms.size(); ++k) {
      const bool isContact = k >= 1 && k <= model_.contacts().size();
      (isContact ? summary_.timings.contact : summary_.timings.assembly) += timings.terms[k];
    }
    summary_.timings.factorisation = timings.factorisation;
    summary_.timings.solve = timings.solve;
    summary_.timings.projection = recorder_.projectionSeconds();
    summary_.factorNonZeros = std::max(summary_.factorNonZeros, newton_.linearSolver().factorNonZeros());
    summary_.luFactorisations = newton_.linearSolver().numGeneral();
  }

  const Scene& scene_;
  std::function<bool()> halt_;
  RunObserver& observer_;
  Model<Dim>& model_;
  std::vector<Term*> terms_;
  Newton newton_;
  Stepping stepping_;
  Projection<Dim> projection_;
  Recorder<Dim> recorder_;
  ModelRecord record_;
  std::filesystem::path directory_;
  RunFiles files_;
  RunSummary summary_;
  int step_ = 0;
  bool halts_ = false;  ///< after the last step
  double lastFrameTime_ = -std::numeric_limits<double>::infinity();
  double lastRowTime_ = -std::numeric_limits<double>::infinity();
  double secondsBefore_ = 0.0;  ///< of the run up to where it was stopped
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

template <int Dim>
RunSummary runInDimension(const Scene& scene, const std::filesystem::path& directory, bool resumes,
                          const RunOptions& options, RunObserver& observer) {
  const auto model = buildModel<Dim>(scene);
  return Run<Dim>(scene, *model, directory, resumes, options.halt, observer).execute();
}

RunSummary runOrResume(const Scene& scene, const std::filesystem::path& directory, bool resumes,
                       const RunOptions& options, RunObserver& observer) {
  pinLibrariesToOneThread();
  const auto threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  if (scene.dim() == 2) return runInDimension<2>(scene, directory, resumes, options, observer);
  return runInDimension<3>(scene, directory, resumes, options, observer);
}

}  // namespace

RunSummary runScene(const Scene& scene, const std::filesystem::path& directory, const RunOptions& options,
                    RunObserver& observer) {
  return runOrResume(scene, directory, false, options, observer);
}

Scene readResultScene(const std::filesystem::path& directory) {
  const ResultReader result(directory);
  return parseScene(result.model().sceneYaml, result.file().string());
}

RunSummary resumeRun(const Scene& scene, const std::filesystem::path& directory, const RunOptions& options,
                     RunObserver& observer) {
  return runOrResume(scene, directory, true, options, observer);
}

}  // namespace burnish
