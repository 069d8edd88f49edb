#pragma once
#include <string>
#include <vector>

#include "postproc/study/figures/figure.h"
#include "postproc/study/schema_measure.h"

namespace burnish {

/// Error of a measure against the number of basis functions, log-log, a curve per combination of the other
/// parameters, with the observed order. The exact value is extrapolated from the finest three meshes (median
/// over the curves).
struct RefinementFigure {
  std::vector<std::string> runs;
  std::string refine;  ///< parameter that is the mesh
  MeasureSpec measure;
  std::string yTitle;
  CurveLooks looks;

  static Alternative about();
  void check(const std::string& path, const StudyReporter& reporter) const;
  void checkReferences(const std::string& path, const RunReporter& reporter) const;
  void checkOutlooks(const std::string& path, const OutlookReporter& reporter) const;
  std::vector<const StudyRun*> shownRuns(const Study& study) const;
  Files draw(const FigureTask& task) const;
  PrintPage page(const FigureTask& task) const;
};

template <class Visitor>
void describe(Visitor& v, RefinementFigure& s) {
  describeRuns(v, s.runs);
  v.field("refine", s.refine, {.required = true}, "Parameter that is the mesh, coarse to fine.");
  v.field("measure", s.measure, {.required = true}, "The number whose error is drawn.");
  v.field("y_title", s.yTitle, {.longest = kLongestShownText},
          "Title of the y axis; that of the measure when left out.");
  describeLooks(v, s.looks);
}

}  // namespace burnish
