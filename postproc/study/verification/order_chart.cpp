#include "postproc/study/verification/order_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "postproc/draw/chart/chart.h"
#include "postproc/study/evidence/refinement.h"
#include "postproc/text/text_file.h"
#include "postproc/text/ticks.h"

namespace burnish {
namespace {

/// A family's errors and the order that they should have.
struct ErrorCurve {
  std::string label;
  double order = 1.0;
  std::vector<MeshValue> errors;  ///< above the floor of the check
};

/// Curves of one quantity.
struct ErrorChart {
  const CheckSpec* first;
  std::string title;
  std::vector<ErrorCurve> curves;
};

bool haveSameQuantity(const CheckSpec& a, const CheckSpec& b) {
  return a.quantity == b.quantity &&
         std::get<ExpectedOrder>(a.expect).limit == std::get<ExpectedOrder>(b.expect).limit;
}

/// What the errors of several checks are errors of; those of measures have a name.
std::string commonTitle(const std::string& quantity) {
  if (quantity.ends_with(".L2")) return "relative error of the displacement";
  if (quantity.ends_with(".H1")) return "relative error of the gradient";
  return "error of " + quantity;
}

ErrorCurve curveOf(const VerificationCase& verified, const ExpectedOrder& expect, const CheckRow& row) {
  ErrorCurve curve{row.family, expect.order, {}};
  const auto& variants = verified.families.front().variants;
  for (std::size_t m = 0; m < variants.size(); ++m)
    if (row.values[m] && *row.values[m] > expect.floor)
      curve.errors.push_back({variants[m].size, *row.values[m]});
  return curve;
}

std::vector<ErrorChart> chartsOf(const VerificationCase& verified, const std::vector<JudgedCheck>& judged) {
  std::vector<ErrorChart> charts;
  for (const JudgedCheck& check : judged) {
    const auto* expect = std::get_if<ExpectedOrder>(&check.check->expect);
    if (expect == nullptr) continue;
    auto chart = std::find_if(charts.begin(), charts.end(), [&](const ErrorChart& other) {
      return haveSameQuantity(*other.first, *check.check);
    });
    if (chart == charts.end())
      chart = charts.insert(charts.end(), {check.check, check.check->name, {}});
    else if (chart->title != check.check->name)
      chart->title = commonTitle(check.check->quantity.formula);
    for (const CheckRow& row : check.rows)
      if (ErrorCurve curve = curveOf(verified, *expect, row); !curve.errors.empty())
        chart->curves.push_back(std::move(curve));
  }
  std::erase_if(charts, [](const ErrorChart& chart) { return chart.curves.empty(); });
  return charts;
}

/// A dashed line of an order, below the finest meshes of the lowest of the curves that should have it.
ChartCurve referenceLine(const std::vector<ErrorCurve>& curves, double order) {
  constexpr double kBelow = 0.6;
  constexpr std::size_t kMeshes = 3;
  double factor = HUGE_VAL, low = 0.0, high = 0.0;
  for (const ErrorCurve& curve : curves) {
    const auto& [size, error] = curve.errors.back();
    if (curve.order != order || error / std::pow(size, order) >= factor) continue;
    factor = error / std::pow(size, order);
    low = size;
    high = curve.errors[curve.errors.size() - std::min(kMeshes, curve.errors.size())].size;
  }
  const auto at = [&](double size) { return kBelow * factor * std::pow(size, order); };
  return {.label = "", .x = {low, high}, .y = {at(low), at(high)}, .style = CurveStyle{kBlackCurve, 1, -1}};
}

/// Differs for the first dozens of curves, and from the lines of reference.
CurveStyle styleOf(std::size_t number) {
  constexpr int kColors = 6, kDashDotted = 3;
  const int n = static_cast<int>(number), round = n / kColors, color = n % kColors;
  return {color < kBlackCurve ? color : color + 1, round == 0 ? 0 : kDashDotted, n + round};
}

/// All lines of reference are one entry of the legend: the curve above each tells which is which.
void addReferenceLines(const std::vector<ErrorCurve>& curves, Chart& chart) {
  std::set<double> orders;
  for (const ErrorCurve& curve : curves) orders.insert(curve.order);
  std::string label;
  for (const double order : orders) label += (label.empty() ? "" : ", ") + numberText(order, 3);
  label = (orders.size() == 1 ? "order " : "orders ") + label;
  for (const double order : orders) {
    chart.curves.push_back(referenceLine(curves, order));
    chart.curves.back().label = std::exchange(label, "");
  }
}

Chart drawnChart(const ErrorChart& errors, const SizeWords& sizes) {
  constexpr std::size_t kManyCurves = 4;
  Chart chart;
  if (errors.curves.size() > kManyCurves) chart.size = {1200, 1200};  // room for the legend
  chart.x = {.title = sizes.title, .logarithmic = true, .range = {}};
  chart.y = {.title = errors.title, .logarithmic = true, .range = {}};
  for (std::size_t k = 0; k < errors.curves.size(); ++k) {
    const ErrorCurve& curve = errors.curves[k];
    ChartCurve& drawn = chart.curves.emplace_back();
    drawn.label = curve.label.empty() ? "computed" : curve.label;
    drawn.style = styleOf(k);
    for (const MeshValue& error : curve.errors) {
      drawn.x.push_back(error.size);
      drawn.y.push_back(error.value);
    }
  }
  addReferenceLines(errors.curves, chart);
  return chart;
}

}  // namespace

std::vector<std::filesystem::path> drawOrderCharts(const VerificationCase& verified,
                                                   const std::vector<JudgedCheck>& judged,
                                                   const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> files;
  for (const ErrorChart& errors : chartsOf(verified, judged)) {
    makeDirectory(directory);
    files.push_back(directory / fmt::format("{}-{}.png", verified.name, files.size() + 1));
    drawChart(drawnChart(errors, verified.sizes), files.back());
  }
  return files;
}

}  // namespace burnish
