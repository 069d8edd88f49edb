#pragma once
#include <string>
#include <vector>

#include "postproc/study/figures/figure.h"
#include "postproc/surface/face_roughness.h"

namespace burnish {

/// Profiles of a face of plane bodies, levelled and, with a cut-off, filtered: a curve for each run and time.
struct RoughnessFigure {
  std::vector<std::string> runs;
  std::vector<double> times;
  std::vector<std::string> timeLabels;  ///< as many as times, or none
  RoughnessSpec face;
  CurveLooks looks;

  static Alternative about();
  void check(const std::string& path, const StudyReporter& reporter) const;
  void checkReferences(const std::string& path, const RunReporter& reporter) const;
  void checkOutlooks(const std::string& path, const OutlookReporter& reporter) const;
  Files draw(const FigureTask& task) const;
  PrintPage page(const FigureTask& task) const;
};

template <class Visitor>
void describe(Visitor& v, RoughnessFigure& s) {
  describeRuns(v, s.runs);
  describeTimes(v, s.times, s.timeLabels);
  describe(v, s.face);
  describeLooks(v, s.looks);
}

}  // namespace burnish
