#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "postproc/study/figures/figure.h"
#include "postproc/study/schema_measure.h"

namespace burnish {

/// Curves y(x), one for each run, from the histories. Expressions are formulas in the columns.
struct HistoryFigure {
  std::vector<std::string> runs;  ///< patterns
  std::string x = "time", y;
  std::string where = "1";  ///< rows in which this is not zero are shown
  std::string xTitle, yTitle;
  CurveLooks looks;
  std::optional<std::string> reference;  ///< PNG (shown beside) or CSV (x and y columns, drawn as points)

  static Alternative about();
  void check(const std::string& path, const StudyReporter& reporter) const;
  void checkReferences(const std::string& path, const RunReporter& reporter) const;
  void checkOutlooks(const std::string& path, const OutlookReporter& reporter) const;
  std::vector<std::filesystem::path> inputs(const std::filesystem::path& studyFile) const;
  Files draw(const FigureTask& task) const;
  PrintPage page(const FigureTask& task) const;

 private:
  /// The file of the reference if it is a picture; empty else.
  std::filesystem::path pictureBeside(const FigureTask& task) const;
};

template <class Visitor>
void describe(Visitor& v, HistoryFigure& s) {
  describeRuns(v, s.runs);
  describeCurve(v, s.x, s.y, s.where);
  v.field("x_title", s.xTitle, {.longest = kLongestShownText},
          "Title of the x axis; the formula when left out.");
  v.field("y_title", s.yTitle, {.longest = kLongestShownText},
          "Title of the y axis; the formula when left out.");
  describeLooks(v, s.looks);
  v.field("reference", s.reference, {},
          "File, relative to the study file: a PNG picture is shown beside the chart, points of a CSV file "
          "(x and y) in it.");
}

}  // namespace burnish
