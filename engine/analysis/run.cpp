#include "engine/analysis/run.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "engine/analysis/build_model.h"
#include "engine/analysis/failure.h"
#include "engine/analysis/frames.h"
#include "engine/analysis/free_tools.h"
#include "engine/analysis/initial_state.h"
#include "engine/analysis/model.h"
#include "engine/analysis/path_steps.h"
#include "engine/analysis/regrader.h"
#include "engine/analysis/rezoner.h"
#include "engine/analysis/run_output.h"
#include "engine/analysis/scene_report.h"
#include "engine/analysis/simulation.h"
#include "engine/analysis/summarise.h"
#include "engine/analysis/time_grid.h"
#include "engine/core/blas.h"
#include "engine/core/error.h"
#include "engine/core/stopwatch.h"
#include "engine/results/result_reader.h"
#include "engine/scene/reader.h"
#include "engine/scene/scene_places.h"
#include "engine/solver/stepping.h"

namespace burnish::inline analysis {
namespace {

/// One run of a scene of given dimension.
template <int Dim>
class Run {
 public:
  /// resumes: goes on with the run that was stopped in the directory.
  Run(const Scene& scene, std::unique_ptr<Model<Dim>> model, const std::filesystem::path& directory,
      bool resumes, const RunOptions& options, RunObserver& observer)
      : scene_(scene),
        halt_(options.halt),
        keepEvery_(options.keepEvery),
        team_(*options.team),
        observer_(observer),
        simulation_(simulationFrom(scene, std::move(model), team_)),
        pathSteps_(scene),
        output_(directory, checkedRecord(resumes), simulation_->recorder.columns(), resumes,
                simulation_->newton.linearSolver().isIterative(), observer, team_) {
    if (scene.rezoning) rezoner_.emplace(scene, *simulation_, team_);
  }

  RunSummary execute() {
    warn();
    team_.first([&] { observer_.onStart(output_.model()); });
    try {
      end(begin() ? walk() : Walk::Failed);
    } catch (const RunError& error) {
      summary_.stoppedBecause = fmt::format("after t = {:.6g}: {}", state().time, error.what());
    }
    summarise();
    if (!summary_.halted) output_.finish(summary_);  // a summary means that a run has ended
    return std::move(summary_);
  }

  /// All that the rest of the run depends on.
  void archive(StateArchive& archive) {
    summary_.timings.total = seconds();
    if (rezoner_) archiveRezoner(archive);
    archive.part("stepping", simulation_->stepping);
    if (archive.restores() && simulation_->model->releaseBehind(state().time, state().x))
      simulation_ = letGo(scene_, *simulation_, team_);
    archive.part("newton", simulation_->newton);
    for (std::size_t k = 0; k < simulation_->terms.size(); ++k)
      archive.part(fmt::format("term{}", k), *simulation_->terms[k]);
    archive.part("recorder", simulation_->recorder);
    archive.part("summary", summary_);
    if (hasInitialState(scene_)) archiveInitialState(archive);
    archive.part("output", output_);
    archive.part("path_steps", pathSteps_);
    archive.field("step", step_);
    if (archive.restores()) secondsBefore_ = summary_.timings.total;
  }

 private:
  static std::unique_ptr<Simulation<Dim>> simulationFrom(const Scene& scene,
                                                         std::unique_ptr<Model<Dim>> model,
                                                         const Team& team) {
    SteppingState start = model->startState();
    return std::make_unique<Simulation<Dim>>(scene, std::move(model), std::move(start), team);
  }

  /// The model as the result has it. Before anything is written, refuses what can be seen to have no good
  /// end.
  ModelRecord checkedRecord(bool resumes) {
    ModelRecord record = makeModelRecord(scene_, *simulation_->model);
    if (resumes) return record;
    requireKnownColumns(scene_, simulation_->recorder.columns());
    team_.first([&] { observer_.onModel(record); });
    return record;
  }

  void warn() {
    const auto warnings = sceneWarnings(scene_, *simulation_->model, simulation_->recorder.columns());
    for (const InputProblem& warning : warnings)
      summary_.warnings.push_back(fmt::format("{}: {}", warning.path, warning.text));
    team_.first([&] { observer_.onWarnings(warningLines(scene_, warnings)); });
  }

  /// Comes to the state at t = 0, or to the one in which the run was stopped; false if the way there failed.
  bool begin() {
    std::optional<SavedState> restart = output_.restart();
    if (!restart) return approach() == Walk::Arrived;
    restore(std::move(*restart));
    return true;
  }

  void restore(SavedState state) {
    StateArchive saved(std::move(state));
    archive(saved);
    output_.showAgain();
  }

  /// Brings lifted tools down and records the state at t = 0.
  Walk approach() {
    auto forces = simulation_->evaluateHere();
    if (hasInitialState(scene_)) {
      summary_.initialStressChange = settleInitialState(*simulation_);
      forces = simulation_->evaluateHere();
    }
    simulation_->recorder.update({state().time, state().x, forces.bulk}, forces.onSupports, {});
    for (Term* term : simulation_->terms) term->accept();
    Walk walk = Walk::Arrived;
    const double startTime = simulation_->model->startTime();
    if (startTime < 0.0) {
      walk = simulation_->stepping.advance(0.0, -0.25 * startTime, [this](const StepReport& step) {
        record();
        addResiduals(summary_, step.newton);
        ++summary_.approachSteps;
        summary_.approachIterations += step.iterations;
        return true;
      });
      simulation_->stepping.forgetIncrement();
    }
    output_.appendRow(simulation_->recorder, 0, 0);
    if (walk == Walk::Arrived) writeFrame();
    return walk;
  }

  /// Goes from time point to time point until the last one, and writes a frame wherever one is due.
  Walk walk() {
    const auto grid = timeGrid(scene_, simulation_->model->corners());
    endTime_ = grid.back().time;
    rezoningIsDue_ = needsRezoning();
    double from = 0.0;
    for (const TimePoint& point : grid) {
      const double before = std::exchange(from, point.time);
      if (point.time < state().time) continue;  // of a run that is resumed
      const bool isNew = state().time < point.time;
      const double step = pathSteps_.size(before, point.time, point.nominalStep);
      if (const Walk walk = walkTo(point.time, step); walk != Walk::Arrived) return walk;
      if (isNew) pathSteps_.measure(*simulation_->model, point.time);
      // A record that is kept where a frame is due would have its name, and stand alone until the frame is written.
      if (point.frame && !output_.hasFrameAt(point.time)) {
        writeFrame();
      } else {
        letGoHere();
        if (!point.frame && !halts_ && keepingIsDue()) keepState();
      }
      if (point.corner) simulation_->stepping.forgetIncrement();
      if (halts_ && point.time < endTime_) return Walk::Halted;
    }
    return Walk::Arrived;
  }

  /// Steps to a time point, and remeshes the body on the way whenever that is due.
  Walk walkTo(double time, double nominal) {
    Walk walk = Walk::Arrived;
    do {
      if (std::exchange(rezoningIsDue_, false)) rezone();
      walk = simulation_->stepping.advance(time, nominal, [this](const StepReport& step) {
        takeIn(step);
        rezoningIsDue_ = needsRezoning();
        return !halts_ && !rezoningIsDue_ && !keepingIsDue();
      });
      if (walk == Walk::Halted && !halts_ && keepingIsDue()) keepState();
    } while (walk == Walk::Halted && !halts_);
    return walk;
  }

  /// Frees what supports and tools hold up to now and no longer, whose forces go to zero from here on.
  void letGoHere() {
    Model<Dim>& model = *simulation_->model;
    if (!model.releaseBehind(state().time, state().x)) return;
    model.holdReleased(state().time, simulation_->newton.forces());
    simulation_->recorder.noteReleased();
    addCosts(summary_, *simulation_);
    simulation_ = letGo(scene_, *simulation_, team_);
  }

  /// Records a step from t = 0 on.
  void takeIn(const StepReport& step) {
    record();
    addResiduals(summary_, step.newton);
    summary_.maxIterations = std::max(summary_.maxIterations, step.iterations);
    step_ = step.step - summary_.approachSteps;
    output_.appendRow(simulation_->recorder, step_, step.iterations);
    output_.appendConvergence(step_, step);
    team_.first([&] { observer_.onStep({step_, step.time, endTime_, step.iterations, state().cuts}); });
    halts_ = team_.any(halt_());
  }

  /// Hands the state that a step has just reached to the recorder.
  void record() {
    simulation_->record();
    if (const std::string pulled = pulledTool(*simulation_->model); !pulled.empty())
      throw RunError(
          fmt::format("tool '{}' is pulled off the body by the load that it carries; a tool with a free way "
                      "has to be pressed on the body, or its motion prescribed",
                      pulled));
    if (const std::string held = toolHeldBack(*simulation_->model); !held.empty())
      throw RunError(fmt::format(
          "tool '{}' does not carry its force in a pass, as its path leads past the body, or keeps it "
          "from going deep enough; lead the passes over a face that the tool touches, and begin them "
          "deeper in the body (path.start or path.points), the force keeps the tool from going so far",
          held));
  }

  /// The frame shows the state before supports and tools let go, and runs are resumed from the one behind.
  void writeFrame() {
    const Stopwatch stopwatch(summary_.timings.output);
    const FrameRecord frame = nextFrame();
    letGoHere();
    output_.append(frame, state().steps, save());
    kept_ = std::chrono::steady_clock::now();
  }

  /// Whether so much time has gone by since a state was kept, on any rank.
  bool keepingIsDue() const { return team_.any(secondsSince(kept_) >= keepEvery_); }

  void keepState() {
    const Stopwatch stopwatch(summary_.timings.output);
    output_.keep(state().steps, save());
    kept_ = std::chrono::steady_clock::now();
  }

  /// The current state as the next frame.
  FrameRecord nextFrame() {
    FrameRecord frame = makeFrame(scene_, *simulation_->model, simulation_->projections, summary_.frames,
                                  step_, state().time, state().x, team_);
    if (rezoner_) frame.mesh = rezoner_->frameMesh(*simulation_, frame.displacement);
    output_.accept(frame);
    ++summary_.frames;
    return frame;
  }

  void end(Walk walk) {
    summary_.completed = walk == Walk::Arrived;
    summary_.halted = walk == Walk::Halted;
    if (walk == Walk::Failed) {
      const Failure failure = diagnose(scene_, *simulation_);
      summary_.stoppedBecause = failure.findings;
      summary_.advice = failure.advice;
      keepLastState();
    }
    if (walk == Walk::Halted) {
      summary_.stoppedBecause = fmt::format("halted at t = {:.6g}", state().time);
      output_.keep(state().steps, save());
    }
  }

  /// After a failed step: the last accepted state becomes the last frame, unless it was refused.
  void keepLastState() {
    const double time = state().time;
    if (!output_.hasRowAt(time) || output_.hasFrameAt(time)) return;
    static_cast<void>(simulation_->evaluateHere());
    output_.appendLast(nextFrame());
  }

  void summarise() {
    addCosts(summary_, *simulation_);
    if (!summary_.halted) simulation_->recorder.noteEnd();
    summary_.program = output_.model().program;
    summary_.steps = step_;
    summary_.timings.total = seconds();
    describeEnd(summary_, *simulation_);
    describeRanks(summary_, *simulation_, team_);
    summary_.pathSteps = pathSteps_.records();
    if (!rezoner_) return;
    summary_.rezonings = rezoner_->records();
    summary_.rezonedBody = scene_.rezoning->body;
    summary_.failedRezonings = rezoner_->numFailures();
    summary_.rezoningFailure = rezoner_->lastFailure();
  }

  bool needsRezoning() const { return rezoner_ && rezoner_->isDue(*simulation_); }

  /// Goes on with a simulation on a new mesh; without success the run goes on as it is.
  void rezone() {
    auto next = rezoner_->rezone(*simulation_);
    if (!next) return simulation_->recorder.noteFailedRezoning();
    addResiduals(summary_, rezoner_->lastReport());
    addCosts(summary_, *simulation_);
    simulation_ = std::move(next);
  }

  void archiveRezoner(StateArchive& archive) {
    archive.part("rezoner", *rezoner_);
    if (archive.restores() && !rezoner_->records().empty()) simulation_ = rezoner_->restoredSimulation();
  }

  void archiveInitialState(StateArchive& archive) {
    double change = summary_.initialStressChange.value_or(0.0);
    archive.field("initial_stress_change", change);
    summary_.initialStressChange = change;
  }

  SavedState save() {
    StateArchive saved;
    archive(saved);
    return saved.values();
  }

  static double secondsSince(std::chrono::steady_clock::time_point time) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - time).count();
  }

  double seconds() const { return secondsBefore_ + secondsSince(start_); }

  const SteppingState& state() const { return simulation_->stepping.state(); }

  const Scene& scene_;
  std::function<bool()> halt_;
  double keepEvery_;
  const Team& team_;
  RunObserver& observer_;
  std::unique_ptr<Simulation<Dim>> simulation_;
  PathSteps pathSteps_;
  RunOutput output_;
  std::optional<std::conditional_t<Dim == 2, Rezoner, Regrader>> rezoner_;
  RunSummary summary_;
  int step_ = 0;  ///< from t = 0 on
  double endTime_ = 0.0;
  bool halts_ = false;  ///< after the last step
  bool rezoningIsDue_ = false;
  double secondsBefore_ = 0.0;  ///< of the run up to where it was stopped
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), kept_ = start_;
};

template <int Dim>
RunSummary runInDimension(const Scene& scene, const std::filesystem::path& directory, bool resumes,
                          const RunOptions& options, RunObserver& observer) {
  return Run<Dim>(scene, buildModel<Dim>(scene), directory, resumes, options, observer).execute();
}

/// Throws `Error` with the place of what several ranks cannot compute together.
void requireDivisible(const Scene& scene) {
  std::vector<InputProblem> problems;
  if (scene.dim() == 2)
    problems.push_back({"geometry", "found two dimensions; several processes compute bodies in space only."});
  else if (scene.solver.newton.linear.name == "direct")
    problems.push_back(
        {"solver.linear",
         "found direct, whose factors several processes cannot divide; allowed: multigrid, auto."});
  if (!problems.empty()) throw Error(textWithPlaces(scene, problems));
}

RunSummary runOrResume(const Scene& scene, const std::filesystem::path& directory, bool resumes,
                       const RunOptions& options, RunObserver& observer) {
  pinLibrariesToOneThread();
  if (!options.team->isAlone()) requireDivisible(scene);
  const int most = options.team->isAlone() ? tbb::info::default_concurrency() : 1;
  const auto threads = threadsWithMemory(options.threads > 0 ? options.threads : most);
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

}  // namespace burnish::inline analysis
