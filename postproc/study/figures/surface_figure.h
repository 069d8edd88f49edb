#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "postproc/study/figures/figure.h"

namespace burnish {

enum class SurfaceQuantity { Pressure, Gap };

constexpr auto enumNames(std::type_identity<SurfaceQuantity>) {
  return std::array{std::pair{"pressure", SurfaceQuantity::Pressure}, std::pair{"gap", SurfaceQuantity::Gap}};
}

/// A contact quantity over the current x position along the contact face, one picture for each time.
struct SurfaceFigure {
  std::vector<std::string> runs;
  std::vector<double> times;
  std::vector<std::string> timeLabels;  ///< as many as times, or none
  SurfaceQuantity quantity = SurfaceQuantity::Pressure;
  std::optional<std::array<double, 2>> window;  ///< of x; around the contact when left out
  CurveLooks looks;

  static Alternative about();
  void check(const std::string& path, const StudyReporter& reporter) const;
  void checkReferences(const std::string& path, const RunReporter& reporter) const;
  void checkOutlooks(const std::string& path, const OutlookReporter& reporter) const;
  Files draw(const FigureTask& task) const;
  PrintPage page(const FigureTask& task) const;

 private:
  int columns() const { return times.size() % 2 == 0 ? 2 : 1; }
};

template <class Visitor>
void describe(Visitor& v, SurfaceFigure& s) {
  describeRuns(v, s.runs);
  describeTimes(v, s.times, s.timeLabels);
  v.field("quantity", s.quantity, {}, "What is drawn over the x position.");
  v.field("window", s.window, {.increasing = true, .unit = "length"},
          "Smallest and largest x; around the contact when left out.");
  describeLooks(v, s.looks);
}

}  // namespace burnish
