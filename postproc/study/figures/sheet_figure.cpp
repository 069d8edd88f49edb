#include "postproc/study/figures/sheet_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/draw/contour/contour_series.h"
#include "postproc/draw/page/sheet.h"
#include "postproc/study/run_data.h"
#include "postproc/study/run_outlook.h"

namespace burnish {
namespace {

constexpr std::array<double, 2> kEmpty{std::numeric_limits<double>::infinity(),
                                       -std::numeric_limits<double>::infinity()};

/// Throws `Error` for ranges of different units.
FieldRange joined(const FieldRange& a, const FieldRange& b) {
  const auto both = [](const std::array<double, 2>& one, const std::array<double, 2>& other) {
    return std::array{std::min(one[0], other[0]), std::max(one[1], other[1])};
  };
  if (a.whole != kEmpty) requireSameUnit("scale", a.unit, b.unit, "take panel, which gives each its own");
  return {both(a.whole, b.whole), both(a.shown, b.shown), b.unit};
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
  ContourSheet(const FigureTask& task, const SheetFigure& spec) : task_(task), spec_(spec) {
    for (const StudyRun* run : task.study.matching(spec.runs)) data_.emplace_back(*run, task.studyDirectory);
    for (const RunData& data : data_) results_.push_back(data.result());
  }

  Files draw() {
    Files files{task_.file(".png")};
    std::vector<SheetPanel> panels;
    const FieldRange whole = forEachPanel([&](const Panel& panel) {
      const auto picture = task_.file("_" + panel.letter + ".png");
      drawContour(results_[panel.column].model(), panel.at.frame, panel.options, picture);
      panels.push_back({picture, caption(panel)});
      files.push_back(picture);
    });
    std::filesystem::path scale;
    if (sharesOneScale()) {
      files.push_back(scale = task_.file("_scale.png"));
      drawColorScale(results_[0].model(), frame(0, 0).frame, scaleOptions(whole), whole.whole, scale);
    }
    drawSheet(panels, columns(), sheetWidth(), files.front(), themeOf(spec_.panel), scale);
    return files;
  }

  PrintPage page() {
    std::vector<PrintPanel> panels;
    const FieldRange whole = forEachPanel([&](const Panel& panel) {
      panels.push_back(
          {contourPage(results_[panel.column].model(), panel.at.frame, panel.options), caption(panel)});
    });
    std::optional<PrintPage> scale;
    if (sharesOneScale())
      scale = colorScalePage(results_[0].model(), frame(0, 0).frame, scaleOptions(whole), whole.whole);
    return printSheet(panels, columns(), sheetWidth(), themeOf(spec_.panel), scale ? &*scale : nullptr);
  }

 private:
  struct Panel {
    std::size_t row, column;
    std::string letter;
    FrameAt at;
    ContourOptions options;
  };

  /// Returns the range of a scale that all share, if they do.
  template <class Draw>
  FieldRange forEachPanel(const Draw& draw) {
    room_ = roomOfAll();
    const FieldRange whole = sharesOneScale() ? sheetRange() : FieldRange{kEmpty, kEmpty};
    if (chosenWindow() == SheetShare::Sheet) findSheetWindow();
    for (std::size_t row = 0; row < spec_.times.size(); ++row) {
      const FieldRange common = spec_.scale == SheetShare::Row ? rowRange(row) : whole;
      if (chosenWindow() == SheetShare::Row) window_ = rowWindow(row);
      for (std::size_t column = 0; column < data_.size(); ++column) {
        FrameAt at = frame(row, column);
        ContourOptions options = withColors(panelOptions(row, column, at.frame), common.shown);
        draw(Panel{row, column, letters(row * data_.size() + column), std::move(at), std::move(options)});
      }
    }
    return whole;
  }

  bool sharesOneScale() const { return spec_.scale == SheetShare::Sheet; }
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

  const FieldRange& rowRange(std::size_t row) {
    while (rowRanges_.size() <= row) rowRanges_.push_back(foundRange(rowRanges_.size()));
    return rowRanges_[row];
  }

  FieldRange foundRange(std::size_t row) const {
    FieldRange range{kEmpty, kEmpty};
    for (std::size_t column = 0; column < data_.size(); ++column) {
      const FrameRecord shown = frame(row, column).frame;
      range = joined(range, shownRanges(results_[column].model(), shown, panelOptions(row, column, shown)));
    }
    return range;
  }

  /// For the texts of all panels.
  SharedRoom roomOfAll() {
    SharedRoom room{.extremes = {}, .otherRanges = true};
    for (std::size_t row = 0; row < spec_.times.size(); ++row)
      for (std::size_t column = 0; column < data_.size(); ++column) {
        const FrameRecord shown = frame(row, column).frame;
        const ContourOptions options = panelOptions(row, column, shown);
        const FrameView view =
            frameView(results_[column].model(), shown, options, spec_.scale != SheetShare::Panel, false);
        room.note = room.note || view.hasNote;
        room.doubt = room.doubt || !options.doubt.empty();
        if (!view.extremes || sharesOneScale()) continue;
        room.extremes.push_back(*view.extremes);
        room.addArrows(spec_.scale == SheetShare::Row
                           ? endsPassed(*withColors(options, rowRange(row).shown).range, *view.extremes)
                           : view.passed);
      }
    return room;
  }

  FieldRange sheetRange() {
    FieldRange range{kEmpty, kEmpty};
    for (std::size_t row = 0; row < spec_.times.size(); ++row) range = joined(range, rowRange(row));
    return range;
  }

  /// Windows that are given are not shared.
  SheetShare chosenWindow() const {
    return spec_.windows.empty() && !spec_.panel.window ? spec_.window : SheetShare::Panel;
  }

  Eigen::AlignedBox2d rowWindow(std::size_t row) const {
    Eigen::AlignedBox2d window;
    for (std::size_t column = 0; column < data_.size(); ++column) {
      const FrameRecord shown = frame(row, column).frame;
      window.extend(contentOf(results_[column].model(), shown, panelOptions(row, column, shown)));
    }
    return window;
  }

  void findSheetWindow() {
    Eigen::AlignedBox2d window;
    for (std::size_t row = 0; row < spec_.times.size(); ++row) window.extend(rowWindow(row));
    window_ = window;
  }

  ContourOptions panelOptions(std::size_t row, std::size_t column, const FrameRecord& shown) const {
    ContourOptions options = contourOptions(spec_.panel, results_[column], shown);
    options.size = panelSize();
    if (!options.textSize) options.textSize = options.theme.textSize * sheetTextSize(options.size[0]);
    options.title = "";
    options.time = false;
    options.colorScale = !sharesOneScale();
    options.room = room_;
    static_cast<PrintOptions&>(options) = task_.print;
    options.pointsPerPixel = sheetPointsPerPixel(options.size[0]);
    if (!spec_.windows.empty()) options.window = spec_.windows[row];
    if (window_) options.window = window_;
    return options;
  }

  /// common: ends of a shared scale.
  ContourOptions withColors(ContourOptions options, const std::array<double, 2>& common) const {
    if (spec_.scale == SheetShare::Panel || options.range) return options;
    options.range = widened(common);
    options.clip.reset();  // it is in the range
    return options;
  }

  /// Of the scale of all panels, in a picture as wide as they are together.
  ContourOptions scaleOptions(const FieldRange& range) const {
    ContourOptions options = withColors(panelOptions(0, 0, frame(0, 0).frame), range.shown);
    options.size[0] = sheetInnerWidth(columns(), sheetWidth());
    return options;
  }

  std::string caption(const Panel& panel) const {
    const StudyRun& run = data_[panel.column].run();
    std::map<std::string, std::string> words = run.parameters;
    words["letter"] = panel.letter;
    words["label"] = run.label;
    words["time"] = timeText(spec_.times, spec_.timeLabels, panel.row);
    const std::string text = fillIn(spec_.panelCaption, words);
    return panel.at.stoppedBefore ? withStop(text, panel.at.frame.time) : text;
  }

  const FigureTask& task_;
  const SheetFigure& spec_;
  std::vector<RunData> data_;
  std::vector<ResultReader> results_;
  std::vector<FieldRange> rowRanges_;
  std::optional<Eigen::AlignedBox2d> window_;             ///< that panels share
  SharedRoom room_{.extremes = {}, .otherRanges = true};  ///< the same
};

}  // namespace

Alternative SheetFigure::about() {
  return {"sheet", "Contour pictures in a grid, a row for each time and a column for each run."};
}

void SheetFigure::check(const std::string& path, const StudyReporter& reporter) const {
  reporter.requireSameLength(path + ".time_labels", timeLabels.size(), "times", times.size());
  reporter.requireSameLength(path + ".zooms", windows.size(), "times", times.size());
  if (!windows.empty() && panel.window)
    reporter.report(path + ".zooms", "found beside zoom; the two exclude each other: give one of them.");
  reporter.checkPicture(path, panel, "panel_size");
}

void SheetFigure::checkReferences(const std::string& path, const RunReporter& reporter) const {
  for (const StudyRun* run : reporter.runsOf(path + ".runs", runs)) {
    auto parameters = run->parameters;
    for (const char* name : {"letter", "label", "time"}) parameters.emplace(name, "");
    if (!reporter.tryTo(path + ".panel_caption", [&] { fillIn(panelCaption, parameters); })) return;
  }
}

void SheetFigure::checkOutlooks(const std::string& path, const OutlookReporter& reporter) const {
  const RunReporter::Runs shown = reporter.runsOf(path + ".runs", runs);
  reporter.requirePicture(path, panel, shown, "panel_size");
  reporter.requireFrames(path + ".times", times, shown);
}

std::optional<double> SheetFigure::clipOfAll() const {
  return scale == SheetShare::Panel ? std::nullopt : panel.clip;
}

Files SheetFigure::draw(const FigureTask& task) const {
  return ContourSheet(task, *this).draw();
}

PrintPage SheetFigure::page(const FigureTask& task) const {
  return ContourSheet(task, *this).page();
}

}  // namespace burnish
