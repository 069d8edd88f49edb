#include "postproc/study/figures/animation_figure.h"

#include <fmt/format.h>

#include <numeric>

#include "postproc/draw/contour/contour_series.h"
#include "postproc/draw/page/sheet.h"
#include "postproc/export/video.h"
#include "postproc/study/run_data.h"
#include "postproc/study/run_outlook.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

/// Pictures of all frames of a run with one colour range and one window.
Files drawFrames(const FigureTask& task, const AnimationFigure& spec, const StudyRun& run) {
  const ResultReader result = RunData(run, task.studyDirectory).result();
  const ModelRecord& model = result.model();
  std::vector<int> all(static_cast<std::size_t>(result.numFrames()));
  std::iota(all.begin(), all.end(), 0);
  ContourOptions options = contourOptions(spec.picture, result, result.frame(0));
  if (!options.textSize) options.textSize = options.theme.textSize * sheetTextSize(options.size[0], 6.0);
  if (!options.title) options.title = run.label;
  options = withCommonView(options, result, all, all);
  const auto directory = task.directory() / task.name / run.name;
  makeDirectory(directory);
  Files frames;
  for (int k = 0; k < result.numFrames(); ++k) {
    frames.push_back(directory / fmt::format("frame_{:04d}.png", k + 1));
    drawContour(model, result.frame(k), options, frames.back());
  }
  return frames;
}

}  // namespace

Alternative AnimationFigure::about() {
  return {"animation", "Every frame of each run as a picture, and as a video where ffmpeg is installed."};
}

void AnimationFigure::check(const std::string& path, const StudyReporter& reporter) const {
  reporter.checkPicture(path, picture, "size");
}

void AnimationFigure::checkReferences(const std::string& path, const RunReporter& reporter) const {
  reporter.runsOf(path + ".runs", runs);
}

void AnimationFigure::checkOutlooks(const std::string& path, const OutlookReporter& reporter) const {
  reporter.requirePicture(path, picture, reporter.runsOf(path + ".runs", runs), "size");
}

Files AnimationFigure::draw(const FigureTask& task) const {
  Files files{task.file(".png")};
  std::vector<SheetPanel> lastFrames;
  for (const StudyRun* run : task.study.matching(runs)) {
    const Files frames = drawFrames(task, *this, *run);
    const auto video = task.file("_" + run->name + ".mp4");
    if (writeVideo(frames, framesPerSecond, video)) files.push_back(video);
    files.insert(files.end(), frames.begin(), frames.end());
    lastFrames.push_back({frames.back(), ""});
  }
  drawSheet(lastFrames, 1, drawnSize(picture)[0], files.front(), themeOf(picture));
  return files;
}

}  // namespace burnish
