#include "postproc/study/figures/figure.h"

#include <fmt/format.h>

#include <algorithm>

#include "postproc/draw/page/sheet.h"
#include "postproc/study/run_data.h"

namespace burnish {
namespace {

/// The number of a parameter's value among all values that any runs of the study give it; runs without the
/// parameter come last.
int valueNumber(const Study& study, const StudyRun& run, const std::string& parameter) {
  std::vector<std::string> values;
  for (const RunsSpec& runs : study.spec.runs)
    for (const ParameterSpec& varied : runs.vary)
      if (varied.name == parameter)
        for (const std::string& value : varied.values)
          if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  const auto own = run.parameters.find(parameter);
  const auto found =
      own == run.parameters.end() ? values.end() : std::find(values.begin(), values.end(), own->second);
  return static_cast<int>(found - values.begin());
}

}  // namespace

PrintPage asColumn(PrintPage page) {
  page.pointsPerPixel = sheetPointsPerPixel(static_cast<int>(page.size[0]));
  return page;
}

Files drawWithData(const Chart& chart, const std::filesystem::path& png) {
  std::filesystem::path csv = png;
  csv.replace_extension(".csv");
  drawChart(chart, png);
  writeChartData(chart, csv);
  return {png, csv};
}

std::optional<CurveStyle> styleOf(const Study& study, const StudyRun& run, const CurveLooks& looks) {
  if (!looks.color && !looks.dash && !looks.marker) return {};
  CurveStyle style;
  if (looks.color) style.color = valueNumber(study, run, *looks.color);
  if (looks.dash) style.dash = valueNumber(study, run, *looks.dash);
  if (looks.marker) style.marker = valueNumber(study, run, *looks.marker);
  return style;
}

std::string timeText(const std::vector<double>& times, const std::vector<std::string>& labels,
                     std::size_t number) {
  if (!labels.empty()) return labels[number];
  return times[number] == kEndOfRun ? "at the end" : fmt::format("t = {:.4g}", times[number]);
}

std::string withStop(const std::string& text, double stoppedAt) {
  return fmt::format("{} ({})", text, stoppedText(stoppedAt));
}

}  // namespace burnish
