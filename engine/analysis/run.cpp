#include "engine/analysis/run.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "engine/analysis/frames.h"
#include "engine/analysis/model.h"
#include "engine/analysis/time_grid.h"
#include "engine/core/blas.h"
#include "engine/core/error.h"
#include "engine/core/stopwatch.h"
#include "engine/results/history.h"
#include "engine/results/result_writer.h"
#include "engine/results/summary_file.h"
#include "engine/solver/stepping.h"

namespace burnish {
namespace {

std::vector<DoubtRecord> doubtRecords(const std::vector<Doubt>& doubts) {
  std::vector<DoubtRecord> records;
  for (const Doubt& doubt : doubts) records.push_back({doubt.what, doubt.firstTime, doubt.steps});
  std::sort(records.begin(), records.end(),
            [](const DoubtRecord& a, const DoubtRecord& b) { return a.firstTime < b.firstTime; });
  return records;
}

/// The summary under the names of docs/results.md.
SummaryRecord makeSummaryRecord(const RunSummary& s) {
  return {.program = s.program,
          .completed = s.completed,
          .stoppedBecause = s.stoppedBecause,
          .doubts = doubtRecords(s.doubts),
          .numbers = {{"end_time", s.end.time},
                      {"functions", s.functions},
                      {"unknowns", s.unknowns},
                      {"approach_steps", s.approachSteps},
                      {"approach_iterations", static_cast<double>(s.approachIterations)},
                      {"steps", s.steps},
                      {"cut_backs", s.cuts},
                      {"smallest_step", s.smallestStep},
                      {"iterations", static_cast<double>(s.iterations)},
                      {"mean_iterations", s.meanIterations},
                      {"max_iterations", s.maxIterations},
                      {"tolerance", s.tolerance},
                      {"constraint_tolerance", s.constraintTolerance},
                      {"worst_residual", s.worstResidual},
                      {"worst_constraint", s.worstConstraint},
                      {"steps_at_round_off", s.stepsAtRoundOff},
                      {"contact_parameter", s.contactParameter},
                      {"smallest_J", s.smallestJ},
                      {"largest_penetration", s.largestPenetration},
                      {"factor_non_zeros", static_cast<double>(s.factorNonZeros)},
                      {"lu_factorisations", static_cast<double>(s.luFactorisations)},
                      {"seconds", s.timings.total},
                      {"assembly_seconds", s.timings.assembly},
                      {"contact_seconds", s.timings.contact},
                      {"factorisation_seconds", s.timings.factorisation},
                      {"solve_seconds", s.timings.solve},
                      {"projection_seconds", s.timings.projection},
                      {"output_seconds", s.timings.output}}};
}

/// One run of a scene of given dimension.
template <int Dim>
class Run {
 public:
  Run(const Scene& scene, Model<Dim>& model, const std::filesystem::path& directory, RunObserver& observer)
      : scene_(scene),
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
        directory_(prepared(directory)),
        writer_(directory_, record_),
        history_(directory_ / "history.csv", recorder_.columns()),
        convergence_(directory_ / "convergence.csv", {"step", "time", "iteration", "residual"}) {}

  RunSummary execute() {
    {
      const Stopwatch stopwatch(summary_.timings.total);
      observer_.onStart(record_);
      try {
        summary_.completed = approach() && walk();
        if (!summary_.completed) noteFailure();
      } catch (const RunError& error) {
        summary_.stoppedBecause = fmt::format("after t = {:.6g}: {}", stepping_.state().time, error.what());
      }
      if (!summary_.completed) keepLastState();
    }
    fillSummary();
    writeSummary(directory_, makeSummaryRecord(summary_));
    return std::move(summary_);
  }

 private:
  static NewtonOptions newtonOptions(const Scene& scene) {
    return {.tolerance = scene.solver.tolerance, .maxIterations = scene.solver.maxIterations};
  }

  /// The directory without the summary of an earlier run.
  static const std::filesystem::path& prepared(const std::filesystem::path& directory) {
    removeSummary(directory);
    return directory;
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
  bool approach() {
    const Forces forces = evaluateHere();
    recorder_.update({stepping_.state().time, stepping_.state().x, forces.bulk}, forces.total);
    for (Term* term : terms_) term->accept();
    bool arrived = true;
    if (model_.startTime() < 0.0) {
      arrived = stepping_.advance(0.0, -0.25 * model_.startTime(), [this](const StepReport& step) {
        record(step);
        noteResiduals(step);
        ++summary_.approachSteps;
        summary_.approachIterations += step.iterations;
      });
      stepping_.forgetIncrement();
    }
    append(0, 0);
    if (arrived) writeFrame();
    return arrived;
  }

  bool walk() {
    const auto grid = timeGrid(scene_, model_.corners());
    const int stepsBefore = stepping_.state().steps;
    for (const Landing& landing : grid) {
      const bool arrived = stepping_.advance(landing.time, landing.nominalStep, [&](const StepReport& step) {
        record(step);
        noteResiduals(step);
        summary_.maxIterations = std::max(summary_.maxIterations, step.iterations);
        step_ = step.step - stepsBefore;
        append(step_, step.iterations);
        for (std::size_t k = 0; k < step.newton.history.size(); ++k)
          convergence_.append(
              {static_cast<double>(step_), step.time, static_cast<double>(k), step.newton.history[k]});
        observer_.onStep({step_, step.time, grid.back().time, step.size, step.iterations,
                          stepping_.state().cuts, step.newton.residual});
      });
      if (!arrived) return false;
      if (landing.frame) writeFrame();
      if (landing.corner) stepping_.forgetIncrement();
    }
    return true;
  }

  void noteResiduals(const StepReport& step) {
    summary_.worstResidual = std::max(summary_.worstResidual, step.newton.residual);
    summary_.worstConstraint = std::max(summary_.worstConstraint, step.newton.constraint);
    summary_.stepsAtRoundOff += step.newton.atRoundOff ? 1 : 0;
  }

  void writeFrame() {
    const Stopwatch stopwatch(summary_.timings.output);
    const auto& state = stepping_.state();
    const FrameRecord frame =
        makeFrame(scene_, model_, projection_, summary_.frames, step_, state.time, state.x);
    writer_.append(frame);
    ++summary_.frames;
    lastFrameTime_ = state.time;
    observer_.onFrame(record_, frame);
  }

  void noteFailure() {
    const auto& state = stepping_.state();
    const NewtonReport& failure = stepping_.lastFailure();
    summary_.stoppedBecause =
        fmt::format("at t = {:.6g} the smallest step ({:.3g}) failed: {} (last relative residual {:.2e})",
                    state.time, stepping_.lastFailedStep(), describe(failure.outcome), failure.residual);
    if (const std::string pulled = model_.pulledTool(); !pulled.empty())
      summary_.stoppedBecause += fmt::format(
          "; tool '{}' had lost the body: the load that it carries may have pulled it off, or does not "
          "determine "
          "its place",
          pulled);
  }

  void append(int step, int iterations) {
    history_.append(recorder_.row(step, iterations));
    lastRowTime_ = recorder_.current().time;
  }

  /// After a failed step: the last accepted state becomes the last frame, unless it was refused.
  void keepLastState() {
    const double time = stepping_.state().time;
    if (time != lastRowTime_ || (summary_.frames > 0 && time == lastFrameTime_)) return;
    static_cast<void>(evaluateHere());
    writeFrame();
  }

  void fillSummary() {
    const auto& state = stepping_.state();
    const auto& timings = newton_.timings();
    summary_.program = record_.program;
    summary_.functions = record_.numNodes;
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
    if (state.steps > 0 && summary_.unknowns > 0)
      summary_.factorNonZeros = newton_.linearSolver().factorNonZeros();
    summary_.luFactorisations = newton_.linearSolver().numGeneral();
  }

  const Scene& scene_;
  RunObserver& observer_;
  Model<Dim>& model_;
  std::vector<Term*> terms_;
  Newton newton_;
  Stepping stepping_;
  Projection<Dim> projection_;
  Recorder<Dim> recorder_;
  ModelRecord record_;
  std::filesystem::path directory_;
  ResultWriter writer_;
  HistoryWriter history_, convergence_;
  RunSummary summary_;
  int step_ = 0;
  double lastFrameTime_ = 0.0;
  double lastRowTime_ = 0.0;
};

/// The model of a scene; what is wrong with it is said with the scene's file.
template <int Dim>
std::unique_ptr<Model<Dim>> makeModel(const Scene& scene) {
  try {
    return std::make_unique<Model<Dim>>(scene);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", scene.source, error.what()));
  }
}

template <int Dim>
RunSummary runInDimension(const Scene& scene, const std::filesystem::path& directory, RunObserver& observer) {
  const auto model = makeModel<Dim>(scene);
  return Run<Dim>(scene, *model, directory, observer).execute();
}

}  // namespace

RunSummary runScene(const Scene& scene, const std::filesystem::path& directory, const RunOptions& options,
                    RunObserver& observer) {
  pinLibrariesToOneThread();
  const auto threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  if (scene.dim() == 2) return runInDimension<2>(scene, directory, observer);
  return runInDimension<3>(scene, directory, observer);
}

}  // namespace burnish
