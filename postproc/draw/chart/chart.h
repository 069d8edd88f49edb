#pragma once
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "postproc/draw/page/print_file.h"
#include "postproc/draw/page/theme.h"

namespace burnish {

/// How a curve looks. Each of the three runs through a small set of looks, again and again, so that curves
/// stay apart in grey print: `color` (7), `dash` (0 solid, 1 dashed, 2 dotted, 3 dash-dot), `marker` (6; -1:
/// none).
struct CurveStyle {
  int color = 0;
  int dash = 0;
  int marker = -1;
  bool line = true;  ///< false: markers alone, at every point, for what was measured
};

/// Black among the colours of curves, for lines of reference.
inline constexpr int kBlackCurve = 2;

struct ChartCurve {
  std::string label;                ///< of the legend; empty: not in the legend
  std::vector<double> x, y;         ///< of the same length; a point that is not finite interrupts the curve
  std::optional<CurveStyle> style;  ///< by the number of the curve when left out, with markers where useful
  bool onRight = false;             ///< y belongs to the axis at the right, and the legend says so

  static constexpr double kGap = std::numeric_limits<double>::quiet_NaN();  ///< interrupts the curve
};

struct ChartAxis {
  std::string title;  ///< with the unit, as in "tool force in N/mm"; Unicode: Greek letters, ₁, ⁻³, ε̄
  bool logarithmic = false;
  std::optional<std::array<double, 2>> range;  ///< round values around the data when left out
};

/// The points that have a marker, in curves without a style: some (all of a few), all, or none.
enum class ChartMarkers { Some, All, None };

/// A chart of curves y(x).
struct Chart {
  std::string title;  ///< may be empty
  ChartAxis x, y;
  ChartAxis y2;  ///< at the right, drawn if a curve belongs to it
  std::vector<ChartCurve> curves;
  std::array<int, 2> size{1200, 900};  ///< pixels (PNG) or points (SVG, PDF)
  ChartMarkers markers = ChartMarkers::Some;
  bool legend = true;  ///< of the curves with a label
  Theme theme;         ///< its paper, ink, font and size of texts

  bool hasRightAxis() const;
};

/// Draws a chart, with a legend where it covers no curve, in the plot or below it, into a file that ends in
/// .png, .svg or .pdf, which appears under its name only when it is complete. Throws `Error` for a chart
/// without a finite point, curves whose x and y differ in length, values that a logarithmic axis cannot show,
/// empty ranges, sizes out of range or too small for the texts, other endings, and a file that cannot be
/// written.
void drawChart(const Chart& chart, const std::filesystem::path& file);

/// The chart as a page for print. Throws `Error` as `drawChart` does.
PrintPage chartPage(const Chart& chart);

/// The same data as CSV: for every curve two columns, "LABEL x" and "LABEL y", or for the axis at the right
/// "LABEL x2" and "LABEL y2"; short curves end in empty cells.
std::string chartDataText(const Chart& chart);

/// The same in a file. Throws `Error` if it cannot be written.
void writeChartData(const Chart& chart, const std::filesystem::path& csv);

}  // namespace burnish
