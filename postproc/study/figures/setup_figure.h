#pragma once
#include <string>
#include <vector>

#include "postproc/study/figures/figure.h"

namespace burnish {

/// Geometry and boundary conditions of a run.
struct SetupFigure {
  std::string run;

  static Alternative about();
  void checkReferences(const std::string& path, const RunReporter& reporter) const;
  std::vector<const StudyRun*> shownRuns(const Study& study) const;
  Files draw(const FigureTask& task) const;
  PrintPage page(const FigureTask& task) const;
};

template <class Visitor>
void describe(Visitor& v, SetupFigure& s) {
  v.field("run", s.run, {.required = true}, "Name of the run.");
}

}  // namespace burnish
