#pragma once
#include <string>
#include <vector>

#include "postproc/study/figures/figure.h"

namespace burnish {

/// Pictures of other figures in one.
struct CompositeFigure {
  std::vector<std::string> figures;
  std::vector<std::string> captions;  ///< as many as figures, or none
  int columns = 2;

  static Alternative about();
  void check(const std::string& path, const StudyReporter& reporter) const;
  void checkReferences(const std::string& path, const RunReporter& reporter) const;
  std::vector<std::string> parts() const { return figures; }
  std::vector<const StudyRun*> shownRuns(const Study& study) const;
  Files draw(const FigureTask& task) const;
  PrintPage page(const FigureTask& task) const;

 private:
  std::string captionOf(std::size_t part) const { return captions.empty() ? "" : captions[part]; }
};

template <class Visitor>
void describe(Visitor& v, CompositeFigure& s) {
  v.field("figures", s.figures, {.required = true, .minEntries = 1},
          "Names of figures that are not composites themselves.");
  v.field("captions", s.captions, {.longest = kLongestShownText}, "Below each of them; one for each figure.");
  v.field("columns", s.columns, {.atLeast = 1, .atMost = 10}, "Pictures side by side.");
}

}  // namespace burnish
