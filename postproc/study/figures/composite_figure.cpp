#include "postproc/study/figures/composite_figure.h"

#include <fmt/format.h>

#include "engine/core/error.h"
#include "postproc/draw/page/sheet.h"
#include "postproc/study/figures/figures.h"
#include "postproc/study/study_reporter.h"

namespace burnish {
namespace {

const FigureSpec& partNamed(const Study& study, const std::string& name) {
  const FigureSpec& part = figureNamed(study, name);
  if (!partsOf(part).empty()) throw Error(fmt::format("its part {} is a composite itself", name));
  return part;
}

/// The picture of a part, which is drawn if it is missing.
std::filesystem::path pictureOf(const FigureTask& task, const FigureSpec& part) {
  std::filesystem::path picture = task.directory() / (part.name + ".png");
  if (!std::filesystem::exists(picture)) drawFigure(task.study, part, task.studyDirectory);
  return picture;
}

}  // namespace

Alternative CompositeFigure::about() {
  return {"composite", "Other figures side by side in one picture."};
}

void CompositeFigure::check(const std::string& path, const StudyReporter& reporter) const {
  reporter.requireSameLength(path + ".captions", captions.size(), "figures", figures.size());
}

void CompositeFigure::checkReferences(const std::string& path, const RunReporter& reporter) const {
  std::vector<std::string> allowed;
  for (const FigureSpec& figure : reporter.study().spec.figures)
    if (partsOf(figure).empty()) allowed.push_back(figure.name);
  for (std::size_t i = 0; i < figures.size(); ++i)
    reporter.requireKnown(fmt::format("{}.figures[{}]", path, i), figures[i], allowed);
}

std::vector<const StudyRun*> CompositeFigure::shownRuns(const Study& study) const {
  std::vector<const StudyRun*> runs;
  for (const std::string& name : figures)
    for (const StudyRun* run : runsOf(study, partNamed(study, name))) runs.push_back(run);
  return runs;
}

Files CompositeFigure::draw(const FigureTask& task) const {
  std::vector<SheetPanel> panels;
  for (std::size_t k = 0; k < figures.size(); ++k)
    panels.push_back({pictureOf(task, partNamed(task.study, figures[k])), captionOf(k)});
  drawSheet(panels, columns, columns * kChartWidth, task.file(".png"));  // charts keep their size
  return {task.file(".png")};
}

PrintPage CompositeFigure::page(const FigureTask& task) const {
  std::vector<PrintPanel> panels;
  for (std::size_t k = 0; k < figures.size(); ++k) {
    const FigureSpec& part = partNamed(task.study, figures[k]);
    auto page = pageOf(part, {task.study, part.name, task.studyDirectory, task.print});
    panels.push_back({page ? std::move(*page) : pageOfPicture(pictureOf(task, part)), captionOf(k)});
  }
  return printSheet(panels, columns, columns * kChartWidth);
}

}  // namespace burnish
