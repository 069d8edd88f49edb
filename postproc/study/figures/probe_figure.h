#pragma once
#include <string>
#include <vector>

#include "postproc/probe/probe_spec.h"
#include "postproc/study/figures/figure.h"

namespace burnish {

/// Values along a path in the bodies, a curve for each field, run and time; or over time, of a point or as the
/// mean of a path, a curve for each field and run.
struct ProbeFigure {
  std::vector<std::string> runs;
  std::vector<double> times;  ///< the end when empty
  std::vector<std::string> timeLabels;
  ProbeSpec probe;
  CurveLooks looks;

  static Alternative about();
  void check(const std::string& path, const StudyReporter& reporter) const;
  void checkReferences(const std::string& path, const RunReporter& reporter) const;
  void checkOutlooks(const std::string& path, const OutlookReporter& reporter) const;
  Files draw(const FigureTask& task) const;
  PrintPage page(const FigureTask& task) const;
};

template <class Visitor>
void describe(Visitor& v, ProbeFigure& s) {
  describeRuns(v, s.runs);
  describe(v, s.probe);
  v.field("times", s.times, {.atLeast = 0, .increasing = true, .unit = "time"},
          "Times of frames; the end when left out. Not of values over time.");
  v.field("time_labels", s.timeLabels, {.longest = kLongestShownText},
          "What is written instead of t = ..., one for each time.");
  describeLooks(v, s.looks);
}

}  // namespace burnish
