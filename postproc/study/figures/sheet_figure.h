#pragma once
#include <optional>
#include <string>
#include <vector>

#include "postproc/study/figures/figure.h"

namespace burnish {

/// The panels that share something.
enum class SheetShare { Panel, Row, Sheet };

constexpr auto enumNames(std::type_identity<SheetShare>) {
  return std::array{std::pair{"panel", SheetShare::Panel}, std::pair{"row", SheetShare::Row},
                    std::pair{"sheet", SheetShare::Sheet}};
}

/// Contour pictures in a grid: a row for each time, a column for each run.
struct SheetFigure {
  std::vector<std::string> runs;
  std::vector<double> times;
  std::vector<std::string> timeLabels;       ///< "{time}" in the captions; as many as times, or none
  std::vector<Eigen::AlignedBox2d> windows;  ///< of the panels at each time; as many as times, or none
  SheetShare window = SheetShare::Sheet;     ///< where neither `windows` nor one of `panel` is given
  SheetShare scale = SheetShare::Panel;
  std::string panelCaption = "{letter}) {label}, {time}";
  PanelOptions panel = picturesOfSize<PanelOptions>({960, 480});

  static Alternative about();
  void check(const std::string& path, const StudyReporter& reporter) const;
  void checkReferences(const std::string& path, const RunReporter& reporter) const;
  void checkOutlooks(const std::string& path, const OutlookReporter& reporter) const;
  std::optional<double> clipOfAll() const;
  Files draw(const FigureTask& task) const;
  PrintPage page(const FigureTask& task) const;
};

template <class Visitor>
void describe(Visitor& v, SheetFigure& s) {
  describeRuns(v, s.runs);
  describeTimes(v, s.times, s.timeLabels);
  describeField(v, s.panel);
  describe(v, s.panel);
  describeSize(v, s.panel, "panel_size");
  describeTextSize(v, s.panel);
  v.field("zooms", s.windows, {}, "What is seen at each time, instead of one zoom: corners as there.");
  v.field(
      "window", s.window, {},
      "What shares a window without zoom and zooms: in a sheet that does, lengths are the same in all panels.");
  v.field("scale", s.scale, {},
          "What shares a colour scale, which is drawn once below the panels where the sheet shares it.");
  v.field("panel_caption", s.panelCaption, {.longest = kLongestShownText},
          "Below a panel; in braces letter, label and time, and the parameters of the run.");
}

}  // namespace burnish
