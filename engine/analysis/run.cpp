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
#include <optional>
#include <utility>
#include <vector>

#include "engine/analysis/failure.h"
#include "engine/analysis/frames.h"
#include "engine/analysis/model.h"
#include "engine/analysis/rezoner.h"
#include "engine/analysis/scene_report.h"
#include "engine/analysis/simulation.h"
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
  Run(const Scene& scene, std::unique_ptr<Model<Dim>> model, const std::filesystem::path& directory,
      bool resumes, std::function<bool()> halt, RunObserver& observer)
      : scene_(scene),
        halt_(std::move(halt)),
        observer_(observer),
        record_(makeModelRecord(scene, *model)),
        simulation_(makeSimulation(scene, std::move(model))),
        directory_(directory),
        files_(directory, record_, checkedColumns(resumes), resumes) {
    if constexpr (Dim == 2)
      if (scene.rezoning) rezoner_.emplace(scene, *simulation_);
  }

  RunSummary execute() {
    warn();
    observer_.onStart(record_);
    try {
      end(begin() ? walk() : Walk::Failed);
    } catch (const RunError& error) {
      summary_.stoppedBecause = fmt::format("after t = {:.6g}: {}", state().time, error.what());
    }
    fillSummary();
    if (!summary_.halted) files_.finish(makeSummaryRecord(summary_));  // a summary means that a run has ended
    return std::move(summary_);
  }

  /// All that the rest of the run depends on.
  void archive(StateArchive& archive) {
    summary_.timings.total = seconds();
    if (rezoner_) archiveRezoner(archive);
    archive.part("stepping", simulation_->stepping);
    archive.part("newton", simulation_->newton);
    for (std::size_t k = 0; k < simulation_->terms.size(); ++k)
      archive.part(fmt::format("term{}", k), *simulation_->terms[k]);
    archive.part("recorder", simulation_->recorder);
    archive.part("summary", summary_);
    archive.field("step", step_);
    archive.field("last_frame_time", lastFrameTime_);
    archive.field("last_row_time", lastRowTime_);
    if (archive.restores()) secondsBefore_ = summary_.timings.total;
  }

 private:
  static std::unique_ptr<Simulation<Dim>> makeSimulation(const Scene& scene,
                                                         std::unique_ptr<Model<Dim>> model) {
    SteppingState start = model->startState();
    return std::make_unique<Simulation<Dim>>(scene, std::move(model), std::move(start));
  }

  /// Columns of the history; before anything is written, refuses what can be seen to have no good end.
  std::vector<std::string> checkedColumns(bool resumes) {
    std::vector<std::string> columns = simulation_->recorder.columns();
    if (resumes) return columns;
    requireKnownColumns(scene_, columns);
    observer_.onModel(record_);
    return columns;
  }

  const SteppingState& state() const { return simulation_->stepping.state(); }

  void archiveRezoner(StateArchive& archive) {
    archive.part("rezoner", *rezoner_);
    if constexpr (Dim == 2)
      if (archive.restores() && rezoner_->count() > 0) simulation_ = rezoner_->restoredSimulation();
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

  /// Hands the state that a step has just reached to the recorder.
  void record() {
    simulation_->record();
    if (const std::string pulled = simulation_->model->pulledTool(); !pulled.empty())
      throw RunError(
          fmt::format("tool '{}' is pulled off the body by the load that it carries; a tool with a free way "
                      "has to be pressed on the body, or its motion prescribed",
                      pulled));
  }

  /// Brings lifted tools down and records the state at t = 0.
  Walk approach() {
    const auto forces = simulation_->evaluateHere();
    simulation_->recorder.update({state().time, state().x, forces.bulk}, forces.total, {});
    for (Term* term : simulation_->terms) term->accept();
    Walk walk = Walk::Arrived;
    const double startTime = simulation_->model->startTime();
    if (startTime < 0.0) {
      walk = simulation_->stepping.advance(0.0, -0.25 * startTime, [this](const StepReport& step) {
        record();
        noteResiduals(step.newton);
        ++summary_.approachSteps;
        summary_.approachIterations += step.iterations;
        return true;
      });
      simulation_->stepping.forgetIncrement();
    }
    append(0, 0);
    if (walk == Walk::Arrived) writeFrame();
    return walk;
  }

  Walk walk() {
    const auto grid = timeGrid(scene_, simulation_->model->corners());
    rezoningIsDue_ = needsRezoning();
    for (const TimePoint& point : grid) {
      if (point.time < state().time) continue;  // of a run that is resumed
      Walk walk = Walk::Arrived;
      do {
        if (rezoningIsDue_) rezone();
        rezoningIsDue_ = false;
        walk = simulation_->stepping.advance(point.time, point.nominalStep, [&](const StepReport& step) {
          takeIn(step, grid.back().time);
          rezoningIsDue_ = needsRezoning();
          return !halts_ && !rezoningIsDue_;
        });
      } while (walk == Walk::Halted && !halts_);
      if (walk != Walk::Arrived) return walk;
      if (point.frame && lastFrameTime_ != point.time) writeFrame();
      if (point.corner) simulation_->stepping.forgetIncrement();
      if (halts_ && point.time < grid.back().time) return Walk::Halted;
    }
    return Walk::Arrived;
  }

  /// Records a step from t = 0 on.
  void takeIn(const StepReport& step, double endTime) {
    record();
    noteResiduals(step.newton);
    summary_.maxIterations = std::max(summary_.maxIterations, step.iterations);
    step_ = step.step - summary_.approachSteps;
    append(step_, step.iterations);
    for (std::size_t k = 0; k < step.newton.history.size(); ++k)
      files_.appendConvergence(
          {static_cast<double>(step_), step.time, static_cast<double>(k), step.newton.history[k]});
    observer_.onStep(
        {step_, step.time, endTime, step.size, step.iterations, state().cuts, step.newton.residual});
    halts_ = halt_();
  }

  bool needsRezoning() const {
    if constexpr (Dim == 2) return rezoner_ && rezoner_->isDue(*simulation_);
    return false;
  }

  /// Meshes the body anew; without success the run goes on as it is.
  void rezone() {
    if constexpr (Dim == 2) {
      auto next = rezoner_->rezone(*simulation_);
      if (!next) return simulation_->recorder.noteFailedRezoning();
      noteResiduals(rezoner_->lastReport());
      noteTimings();
      simulation_ = std::move(next);
    }
  }

  void end(Walk walk) {
    summary_.completed = walk == Walk::Arrived;
    summary_.halted = walk == Walk::Halted;
    if (walk == Walk::Failed) {
      noteFailure();
      keepLastState();
    }
    if (walk == Walk::Halted) {
      summary_.stoppedBecause = fmt::format("halted at t = {:.6g}", state().time);
      files_.keep(state().steps, save());
    }
  }

  void warn() {
    const auto warnings = sceneWarnings(scene_, *simulation_->model, simulation_->recorder.columns());
    for (const InputProblem& warning : warnings)
      summary_.warnings.push_back(fmt::format("{}: {}", warning.path, warning.text));
    observer_.onWarnings(warningLines(scene_, warnings));
  }

  void noteResiduals(const NewtonReport& report) {
    summary_.worstResidual = std::max(summary_.worstResidual, report.residual);
    summary_.worstConstraint = std::max(summary_.worstConstraint, report.constraint);
    summary_.stepsAtRoundOff += report.atRoundOff ? 1 : 0;
  }

  /// The current state as the next frame.
  FrameRecord nextFrame() {
    FrameRecord frame = makeFrame(scene_, *simulation_->model, simulation_->projection, summary_.frames,
                                  step_, state().time, state().x);
    if constexpr (Dim == 2)
      if (rezoner_) frame.mesh = rezoner_->frameMesh(*simulation_, frame.displacement);
    try {
      checkFrame(frame, record_, fmt::format("the frame at t = {:.6g}", state().time));
    } catch (const Error& error) {
      throw RunError(error.what());
    }
    ++summary_.frames;
    lastFrameTime_ = state().time;
    return frame;
  }

  void writeFrame() {
    const Stopwatch stopwatch(summary_.timings.output);
    const FrameRecord frame = nextFrame();
    files_.append(frame, state().steps, save());
    observer_.onFrame(record_, frame);
  }

  void noteFailure() {
    const NewtonReport& failure = simulation_->stepping.lastFailure();
    summary_.stoppedBecause = fmt::format(
        "at t = {:.6g} the smallest step ({:.3g}) failed: {} (last relative residual {:.2e})", state().time,
        simulation_->stepping.lastFailedStep(), describe(failure.outcome), failure.residual);
    const Failure found = diagnose(*simulation_->model, failure);
    summary_.stoppedBecause += "; " + found.findings;
    summary_.advice = found.advice;
    if (const std::string pulled = simulation_->model->pulledTool(); !pulled.empty())
      summary_.stoppedBecause += fmt::format(
          "; tool '{}' had lost the body: the load that it carries may have pulled it off, or does not "
          "determine its place",
          pulled);
    if (const std::string way = simulation_->model->runawayWay(); !way.empty())
      summary_.stoppedBecause += fmt::format(
          "; {}: the tool would have turned by more than 0.2 radians, or moved by more than the body's size, "
          "in one step, as too little resists it in this way: leave it out of carry, prescribe it, or place "
          "the tool so that it rests on several control points",
          way);
  }

  void append(int step, int iterations) {
    const Recorder<Dim>& recorder = simulation_->recorder;
    const std::vector<double> row = recorder.row(step, iterations);
    for (std::size_t column = 0; column < row.size(); ++column)
      if (!std::isfinite(row[column]))
        throw RunError(fmt::format("{} is not finite at t = {:.6g}", recorder.columns()[column],
                                   recorder.current().time));
    files_.appendHistory(row);
    lastRowTime_ = recorder.current().time;
  }

  /// After a failed step: the last accepted state becomes the last frame, unless it was refused.
  void keepLastState() {
    const double time = state().time;
    if (time != lastRowTime_ || (summary_.frames > 0 && time == lastFrameTime_)) return;
    static_cast<void>(simulation_->evaluateHere());
    const FrameRecord frame = nextFrame();
    files_.appendLast(frame);
    observer_.onFrame(record_, frame);
  }

  /// Adds what the present simulation has spent to the summary.
  void noteTimings() {
    const auto& timings = simulation_->newton.timings();
    for (std::size_t k = 0; k < timings.terms.size(); ++k) {
      const bool isContact =
          k >= 1 && k <= simulation_->model->contacts().size() + simulation_->model->selfContacts().size();
      (isContact ? summary_.timings.contact : summary_.timings.assembly) += timings.terms[k];
    }
    summary_.timings.factorisation += timings.factorisation;
    summary_.timings.solve += timings.solve;
    auto& solver = simulation_->newton.linearSolver();
    summary_.factorNonZeros = std::max(summary_.factorNonZeros, solver.factorNonZeros());
    summary_.luFactorisations += solver.numGeneral();
  }

  void fillSummary() {
    noteTimings();
    if (!summary_.halted) simulation_->recorder.noteEnd();
    const Recorder<Dim>& recorder = simulation_->recorder;
    summary_.timings.total = seconds();
    summary_.program = record_.program;
    summary_.functions = simulation_->model->body().numNodes;
    summary_.unknowns = static_cast<int>(simulation_->newton.system().freeUnknowns().size());
    summary_.steps = step_;
    summary_.cuts = state().cuts;
    summary_.smallestStep = state().smallestStep;
    summary_.iterations = state().iterations - summary_.approachIterations;
    summary_.meanIterations = static_cast<double>(summary_.iterations) / std::max(1, step_);
    summary_.tolerance = scene_.solver.tolerance;
    summary_.constraintTolerance = NewtonOptions{}.constraintTolerance;
    if (!simulation_->model->contacts().empty())
      summary_.contactParameter = simulation_->model->contacts().front().term->options().parameter;
    else if (!simulation_->model->selfContacts().empty())
      summary_.contactParameter = simulation_->model->selfContacts().front().term->options().parameter;
    summary_.end = recorder.current();
    if (summary_.completed) summary_.endVonMises = recorder.projectedVonMises();
    summary_.smallestJ = recorder.smallestJ();
    summary_.largestPenetration = recorder.largestPenetration();
    summary_.stabilised = simulation_->model->stabilisation() != nullptr;
    summary_.largestStabilisedShare = recorder.largestStabilisedShare();
    summary_.doubts = recorder.doubts();
    std::stable_sort(summary_.doubts.begin(), summary_.doubts.end(),
                     [](const DoubtRecord& a, const DoubtRecord& b) { return a.firstTime < b.firstTime; });
    summary_.reactions = recorder.reactions().records();
    summary_.idleTools = recorder.idleTools();
    summary_.timings.projection = recorder.projectionSeconds();
    if (!rezoner_) return;
    summary_.rezonings = rezoner_->records();
    summary_.failedRezonings = rezoner_->numFailures();
    summary_.rezoningFailure = rezoner_->lastFailure();
  }

  const Scene& scene_;
  std::function<bool()> halt_;
  RunObserver& observer_;
  ModelRecord record_;  ///< of the model in which the run begins
  std::unique_ptr<Simulation<Dim>> simulation_;
  std::optional<Rezoner> rezoner_;
  std::filesystem::path directory_;
  RunFiles files_;
  RunSummary summary_;
  int step_ = 0;
  bool halts_ = false;  ///< after the last step
  bool rezoningIsDue_ = false;
  double lastFrameTime_ = -std::numeric_limits<double>::infinity();
  double lastRowTime_ = -std::numeric_limits<double>::infinity();
  double secondsBefore_ = 0.0;  ///< of the run up to where it was stopped
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

template <int Dim>
RunSummary runInDimension(const Scene& scene, const std::filesystem::path& directory, bool resumes,
                          const RunOptions& options, RunObserver& observer) {
  return Run<Dim>(scene, buildModel<Dim>(scene), directory, resumes, options.halt, observer).execute();
}

RunSummary runOrResume(const Scene& scene, const std::filesystem::path& directory, bool resumes,
                       const RunOptions& options, RunObserver& observer) {
  pinLibrariesToOneThread();
  const auto threads =
      threadsWithMemory(options.threads > 0 ? options.threads : tbb::info::default_concurrency());
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
