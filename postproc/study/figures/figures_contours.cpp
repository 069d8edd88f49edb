#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "engine/core/error.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/contour_series.h"
#include "postproc/draw/page/sheet.h"
#include "postproc/export/video.h"
#include "postproc/study/figures/figure_kinds.h"
#include "postproc/study/run_data.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

using Range = std::array<double, 2>;

constexpr Range kNothing{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

Range joined(const Range& a, const Range& b) {
  return {std::min(a[0], b[0]), std::max(a[1], b[1])};
}

/// a, b, …, z, aa, ab, …
std::string letters(std::size_t number) {
  constexpr std::size_t kLetters = 26;
  const std::string last(1, static_cast<char>('a' + number % kLetters));
  return number < kLetters ? last : letters(number / kLetters - 1) + last;
}

/// Draws the panels of a sheet from left to right and from top to bottom.
class ContourSheet {
 public:
  ContourSheet(const FigureTask& task, const ContourSheetSpec& spec) : task_(task), spec_(spec) {
    for (const StudyRun* run : task.study.matching(spec.runs)) data_.emplace_back(*run, task.studyDirectory);
    for (const RunData& data : data_) results_.push_back(data.result());
  }

  Files draw() {
    Files files{task_.file(".png")};
    std::vector<SheetPanel> panels;
    const Range whole = spec_.scale == SheetScale::Sheet ? sheetRange() : kNothing;
    for (std::size_t row = 0; row < spec_.times.size(); ++row) {
      const Range common = spec_.scale == SheetScale::Row ? rowRange(row) : whole;
      for (std::size_t column = 0; column < data_.size(); ++column) {
        panels.push_back(drawPanel(row, column, common));
        files.push_back(panels.back().picture);
      }
    }
    drawSheet(panels, columns(), sheetWidth(), files.front(), themeOf(spec_.panel));
    return files;
  }

 private:
  int columns() const { return static_cast<int>(data_.size()); }
  int sheetWidth() const { return columns() * spec_.panel.size[0]; }

  /// The gutters of the sheet are taken off the panels, so that these are not resized.
  std::array<int, 2> panelSize() const {
    const int width = sheetPanelWidth(columns(), sheetWidth());
    return {width, spec_.panel.size[1] * width / spec_.panel.size[0]};
  }

  FrameAt frame(std::size_t row, std::size_t column) const {
    return frameAt(data_[column], results_[column], spec_.times[row]);
  }

  Range rowRange(std::size_t row) const {
    Range range = kNothing;
    for (std::size_t column = 0; column < data_.size(); ++column) {
      const FrameRecord shown = frame(row, column).frame;
      range = joined(range, shownRange(results_[column].model(), shown, panelOptions(column, shown)));
    }
    return range;
  }

  Range sheetRange() const {
    Range range = kNothing;
    for (std::size_t row = 0; row < spec_.times.size(); ++row) range = joined(range, rowRange(row));
    return range;
  }

  ContourOptions panelOptions(std::size_t column, const FrameRecord& shown) const {
    ContourOptions options = contourOptions(spec_.panel, results_[column], shown);
    options.size = panelSize();
    if (!options.textSize) options.textSize = options.theme.textSize * sheetTextSize(options.size[0]);
    options.title = "";
    options.time = false;
    return options;
  }

  SheetPanel drawPanel(std::size_t row, std::size_t column, const Range& common) const {
    const FrameAt at = frame(row, column);
    const std::string letter = letters(row * data_.size() + column);
    ContourOptions options = panelOptions(column, at.frame);
    if (spec_.scale != SheetScale::Panel && !options.range) {
      options.range = widened(common);
      options.clip.reset();  // it is in the range
    }
    const auto picture = task_.file("_" + letter + ".png");
    drawContour(results_[column].model(), at.frame, options, picture);
    return {picture, caption(row, column, letter, at)};
  }

  std::string caption(std::size_t row, std::size_t column, const std::string& letter,
                      const FrameAt& at) const {
    const StudyRun& run = data_[column].run();
    std::map<std::string, std::string> words = run.parameters;
    words["letter"] = letter;
    words["label"] = run.label;
    words["time"] = timeText(spec_.times, spec_.timeLabels, row);
    const std::string text = fillIn(spec_.panelCaption, words);
    return at.stoppedBefore ? withStop(text, at.frame.time) : text;
  }

  const FigureTask& task_;
  const ContourSheetSpec& spec_;
  std::vector<RunData> data_;
  std::vector<ResultReader> results_;
};

/// Pictures of all frames of a run with one colour range and one window.
Files drawFrames(const FigureTask& task, const AnimationSpec& spec, const StudyRun& run) {
  const ResultReader result = RunData(run, task.studyDirectory).result();
  const ModelRecord& model = result.model();
  std::vector<int> all(static_cast<std::size_t>(result.numFrames()));
  std::iota(all.begin(), all.end(), 0);
  ContourOptions options = contourOptions(spec.picture, result, result.frame(0));
  if (!options.textSize) options.textSize = options.theme.textSize * sheetTextSize(options.size[0], 6.0);
  if (!options.title) options.title = run.label;
  options = withCommonView(options, result, all, all);
  const auto directory = task.directory() / task.figure.name / run.name;
  makeDirectory(directory);
  Files frames;
  for (int k = 0; k < result.numFrames(); ++k) {
    frames.push_back(directory / fmt::format("frame_{:04d}.png", k + 1));
    drawContour(model, result.frame(k), options, frames.back());
  }
  return frames;
}

}  // namespace

Files drawKind(const FigureTask& task, const ContourSheetSpec& spec) {
  return ContourSheet(task, spec).draw();
}

Files drawKind(const FigureTask& task, const AnimationSpec& spec) {
  Files files{task.file(".png")};
  std::vector<SheetPanel> lastFrames;
  for (const StudyRun* run : task.study.matching(spec.runs)) {
    const Files frames = drawFrames(task, spec, *run);
    const auto video = task.file("_" + run->name + ".mp4");
    if (writeVideo(frames, spec.framesPerSecond, video)) files.push_back(video);
    files.insert(files.end(), frames.begin(), frames.end());
    lastFrames.push_back({frames.back(), ""});
  }
  drawSheet(lastFrames, 1, drawnSize(spec.picture)[0], files.front(), themeOf(spec.picture));
  return files;
}

}  // namespace burnish
