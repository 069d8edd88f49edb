#include "postproc/study/figures/setup_figure.h"

#include <array>

#include "postproc/draw/setup/setup_figure.h"
#include "postproc/study/measures.h"
#include "postproc/study/run_data.h"
#include "postproc/study/study_reporter.h"

namespace burnish {

namespace {

constexpr std::array<int, 2> kSetupSize{1200, 720};  // pixels

}  // namespace

Alternative SetupFigure::about() {
  return {"setup", "Geometry and boundary conditions of a run."};
}

void SetupFigure::checkReferences(const std::string& path, const RunReporter& reporter) const {
  reporter.requireKnown(path + ".run", run, namesOf(reporter.study().runs));
}

std::vector<const StudyRun*> SetupFigure::shownRuns(const Study& study) const {
  return {&runNamed(study, run)};
}

Files SetupFigure::draw(const FigureTask& task) const {
  const RunData data(runNamed(task.study, run), task.studyDirectory);
  drawSetup(data.result().model(), kSetupSize, task.file(".png"));
  return {task.file(".png")};
}

PrintPage SetupFigure::page(const FigureTask& task) const {
  const RunData data(runNamed(task.study, run), task.studyDirectory);
  return asColumn(setupPage(data.result().model(), kSetupSize));
}

}  // namespace burnish
