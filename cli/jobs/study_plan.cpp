#include "cli/jobs/study_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <set>
#include <span>
#include <system_error>
#include <thread>

#include "engine/analysis/scene_report.h"
#include "engine/analysis/time_grid.h"
#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/core/fingerprint.h"
#include "engine/core/nearest.h"
#include "engine/core/version.h"
#include "engine/results/history.h"
#include "engine/results/result_reader.h"
#include "engine/results/summary_file.h"
#include "engine/scene/dimension.h"
#include "engine/scene/mesh_knots.h"
#include "postproc/scene/scene_document.h"
#include "postproc/study/figures/figures.h"
#include "postproc/study/study_reader.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

fs::path recordFile(const fs::path& directory, const std::string& figure) {
  return directory / "drawn" / (figure + ".txt");
}

fs::path logFile(const fs::path& directory, const std::string& figure) {
  return directory / "drawn" / (figure + ".log");
}

/// Acts; what `Error` it throws is one of the run, which will tell it.
template <class Act>
void leaveToTheRun(const Act& act) {
  try {
    act();
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch)
  }
}

/// Whether a run has ended, with this program and this scene.
bool isOf(const fs::path& run, const Scene& scene) {
  try {
    const ResultReader result(run);
    return result.model().program == programName() && result.model().sceneYaml == scene.resolvedYaml;
  } catch (const Error&) {
    return false;
  }
}

/// Whether a run has ended, at its end or before.
bool hasEnded(const fs::path& run) {
  try {
    readSummary(run);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// What the results of a run of the scene have. columns: tells those of its history.
template <class Columns>
RunOutlook outlookWith(const Scene& scene, const Columns& columns) {
  RunOutlook outlook = outlookOf(scene);
  leaveToTheRun([&] { outlook.frameTimes = frameTimes(scene); });
  leaveToTheRun([&] { outlook.columns = columns(); });
  return outlook;
}

/// Removes the files of a figure that was drawn before.
void removeDrawn(const fs::path& directory, const std::string& figure) {
  std::error_code absent;
  for (const fs::path& file : drawnFiles(directory, figure)) fs::remove(file, absent);
  fs::remove(recordFile(directory, figure), absent);
}

/// The knots of a shape before it is meshed. Those that bring none have one span per direction.
template <class Shape>
std::vector<KnotVector> shapeKnots(const Shape& shape) {
  if constexpr (BringsKnots<Shape>) return shape.knotVectors();
  return std::vector<KnotVector>(static_cast<std::size_t>(dimensionOf(shape)), KnotVector::uniform(1, 1));
}

/// Number of basis functions of a shape on its mesh, or of all patches.
struct FunctionCount {
  const BodySpec& body;
  const std::vector<DefinitionSpec>& definitions;

  template <class Shape>
  double operator()(const Shape& shape, const MeshSpec& mesh) const {
    double product = 1.0;
    const std::vector<KnotVector> knots = shapeKnots(shape);
    for (std::size_t d = 0; d < knots.size(); ++d)
      product *= numFunctions(body, meshKnots(body, definitions, mesh, d, knots[d]));
    return product;
  }
  double operator()(const PatchesSpec& several, const MeshSpec&) const {
    double sum = 0.0;
    for (const PatchSpec& patch : several.patches)
      sum += std::visit([&](const auto& shape) { return (*this)(shape, patch.mesh); }, patch.shape);
    return sum;
  }
};

class Planner {
 public:
  Planner(const Study& study, const fs::path& directory, int atOnce)
      : study_(study), directory_(directory), atOnce_(atOnce) {
    if (!study.spec.figures.empty()) digest_ = studyDigest(study.file);  // runs alone need no file
  }

  StudyPlan plan(const std::vector<std::string>& only) {
    chooseFigures(only);
    chooseRuns(!only.empty());
    for (PlannedRun& run : plan_.runs)
      if (run.job) run.job = add(runJob(run));
    for (const bool composite : {false, true})
      for (PlannedFigure& figure : plan_.figures)
        if (composite == !partsOf(*figure.figure).empty()) planFigure(figure);
    return std::move(plan_);
  }

 private:
  void chooseFigures(const std::vector<std::string>& only) {
    std::set<std::string> wanted;
    for (const std::string& name : only) {
      wanted.insert(name);
      for (const std::string& part : partsOf(findFigure(study_, name))) wanted.insert(part);
    }
    for (const FigureSpec& figure : study_.spec.figures)
      if (only.empty() || wanted.contains(figure.name)) plan_.figures.push_back({&figure, {}});
  }

  void chooseRuns(bool onlyForFigures) {
    std::set<const StudyRun*> wanted;
    for (const PlannedFigure& figure : plan_.figures)
      for (const StudyRun* run : runsOf(study_, *figure.figure)) wanted.insert(run);
    for (const StudyRun& run : study_.runs) {
      if (onlyForFigures && !wanted.contains(&run)) continue;
      const Scene scene = readSceneDocument(run.scene, run.overrides).scene;
      PlannedRun planned{.run = &run,
                         .directory = runDirectory(directory_, run),
                         .endTime = scene.steps.back().until,
                         .cost = expectedCost(scene),
                         .outlook = {},
                         .job = {}};
      if (isOf(planned.directory, scene) && hasEnded(planned.directory)) {
        planned.outlook =
            outlookWith(scene, [&] { return readHistory(planned.directory / "history.csv").columns; });
      } else {
        planned.outlook = outlookBefore(scene);
        planned.job = 0;  // the place follows
      }
      plan_.runs.push_back(std::move(planned));
    }
  }

  std::size_t add(Job job) {
    plan_.jobs.push_back(std::move(job));
    return plan_.jobs.size() - 1;
  }

  /// The processors are shared by the runs that go on together.
  int threadsPerRun() const {
    const auto runs = std::count_if(plan_.runs.begin(), plan_.runs.end(),
                                    [](const PlannedRun& run) { return run.job.has_value(); });
    const int processors = static_cast<int>(std::thread::hardware_concurrency());
    return std::max(1, processors / std::min(atOnce_, std::max(1, static_cast<int>(runs))));
  }

  Job runJob(const PlannedRun& run) const {
    std::vector<std::string> arguments{"run", "--threads", std::to_string(threadsPerRun()), "--quiet"};
    arguments.insert(arguments.end(), {"--continue", run.run->scene.string(), "-o", run.directory.string()});
    for (const std::string& change : run.run->overrides) arguments.insert(arguments.end(), {"--set", change});
    return {.arguments = arguments, .log = run.directory / "log.txt", .cost = run.cost};
  }

  void planFigure(PlannedFigure& planned) {
    const FigureSpec& figure = *planned.figure;
    Job job{.arguments = {"figures", study_.file.string(), "-o", directory_.string(), "--only", figure.name,
                          "--draw-only"},
            .log = logFile(directory_, figure.name)};
    std::vector<fs::path> inputs{study_.file, "/proc/self/exe"};
    for (fs::path& file : inputsOf(study_, figure)) inputs.push_back(std::move(file));
    for (const StudyRun* run : runsOf(study_, figure)) {
      inputs.push_back(runDirectory(directory_, *run) / "summary.yaml");
      const auto needed = std::find_if(plan_.runs.begin(), plan_.runs.end(),
                                       [&](const PlannedRun& other) { return other.run == run; });
      if (needed->job) job.after.push_back(*needed->job);
    }
    for (const std::string& part : partsOf(figure)) {
      inputs.push_back(recordFile(directory_, part));
      const auto needed =
          std::find_if(plan_.figures.begin(), plan_.figures.end(),
                       [&](const PlannedFigure& other) { return other.figure->name == part; });
      if (needed->job) job.after.push_back(*needed->job);
    }
    if (!job.after.empty() || !isDrawn(figure.name, inputs)) planned.job = add(std::move(job));
  }

  /// Whether all files of a figure are there and younger than what they show.
  bool isDrawn(const std::string& figure, const std::vector<fs::path>& inputs) const {
    const std::vector<fs::path> files = drawnFiles(directory_, figure);
    const auto exists = [](const fs::path& file) {
      std::error_code absent;
      return fs::is_regular_file(file, absent) && fs::file_size(file, absent) > 0;
    };
    if (files.empty() || !std::all_of(files.begin(), files.end(), exists)) return false;
    std::ifstream record(recordFile(directory_, figure));
    std::string digest;
    std::getline(record, digest);
    if (digest != digest_) return false;
    const auto drawn = fs::last_write_time(recordFile(directory_, figure));
    return std::all_of(inputs.begin(), inputs.end(), [&](const fs::path& input) {
      return fs::exists(input) && fs::last_write_time(input) <= drawn;
    });
  }

  const Study& study_;
  std::string digest_;
  fs::path directory_;
  int atOnce_;
  StudyPlan plan_;
};

}  // namespace

std::string studyDigest(const fs::path& studyFile) {
  const std::string text = readText(studyFile);
  Fingerprint digest;
  digest.add(std::as_bytes(std::span(text)));
  return "study " + digest.text();
}

const FigureSpec& findFigure(const Study& study, const std::string& name) {
  std::vector<std::string> names;
  for (const FigureSpec& figure : study.spec.figures) {
    if (figure.name == name) return figure;
    names.push_back(figure.name);
  }
  throw Error(fmt::format("--only: {} has no figure {}; its figures are {}.{}", study.file.string(), name,
                          fmt::join(names, ", "), didYouMean(name, names)));
}

double expectedCost(const Scene& scene) {
  double functions = 0.0;
  int degree = 1;
  for (const BodySpec& body : scene.allBodies()) {
    const FunctionCount count{body, scene.definitions};
    functions +=
        std::visit([&](const auto& shape) { return count(shape, body.geometry.mesh); }, body.geometry.shape);
    degree = std::max(degree, body.degree);
  }
  const double perUnknown = std::pow(degree, scene.dim());
  const int steps = std::accumulate(scene.steps.begin(), scene.steps.end(), 0,
                                    [](int sum, const PhaseSpec& phase) { return sum + phase.count; });
  return scene.dim() * std::pow(functions, scene.dim() == 3 ? 2.0 : 1.5) * perUnknown * steps;
}

RunOutlook outlookBefore(const Scene& scene) {
  return outlookWith(scene, [&] { return historyColumnsOf(scene); });
}

StudyPlan planStudy(const Study& study, const fs::path& directory, const std::vector<std::string>& only,
                    int atOnce) {
  return Planner(study, directory, atOnce).plan(only);
}

void requireOutlooks(const Study& study, const StudyPlan& plan) {
  std::vector<RunOutlook> outlooks(study.runs.size());
  for (const PlannedRun& planned : plan.runs)
    outlooks[static_cast<std::size_t>(planned.run - study.runs.data())] = planned.outlook;
  requireOutlooks(study, outlooks);
}

void prepareJobs(const StudyPlan& plan, const fs::path& directory) {
  makeDirectory(directory / "drawn");
  for (const PlannedRun& run : plan.runs) {
    if (!run.job) continue;
    makeDirectory(run.directory);
    removeSummary(run.directory);
  }
  for (const PlannedFigure& figure : plan.figures)
    if (figure.job) removeDrawn(directory, figure.figure->name);
}

void drawAndRecord(const Study& study, const FigureSpec& figure, const fs::path& directory) {
  removeDrawn(directory, figure.name);
  std::string record = studyDigest(study.file) + "\n";
  for (const fs::path& file : drawFigure(study, figure, directory))
    record += file.lexically_relative(directory).string() + "\n";
  makeDirectory(directory / "drawn");
  writeFileAtomically(recordFile(directory, figure.name), std::as_bytes(std::span(record)));
}

std::vector<fs::path> drawnFiles(const fs::path& directory, const std::string& figure) {
  std::ifstream record(recordFile(directory, figure));
  std::vector<fs::path> files;
  std::string line;
  std::getline(record, line);  // the study's digest
  while (std::getline(record, line)) files.push_back(directory / line);
  return files;
}

}  // namespace burnish
