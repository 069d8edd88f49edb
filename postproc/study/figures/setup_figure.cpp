#include "postproc/study/figures/setup_figure.h"

#include <array>

#include "postproc/draw/setup/setup_figure.h"
#include "postproc/study/measures.h"
#include "postproc/study/run_data.h"
#include "postproc/study/study_reporter.h"

namespace burnish {

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
  constexpr std::array<int, 2> size{1200, 720};
  const RunData data(runNamed(task.study, run), task.studyDirectory);
  drawSetup(data.result().model(), size, task.file(".png"));
  return {task.file(".png")};
}

}  // namespace burnish
