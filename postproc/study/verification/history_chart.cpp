#include "postproc/study/verification/history_chart.h"

#include <fmt/format.h>

#include <string>

#include "postproc/draw/chart/chart.h"
#include "postproc/study/evidence/expression.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

Chart chartOf(const CurveChartSpec& spec, const VerificationCase& verified, const CaseOutcomes& outcomes) {
  Chart chart;
  chart.size = {1200, 1100};  // room for the legend
  chart.x = {.title = spec.xTitle.empty() ? spec.x : spec.xTitle, .range = {}};
  chart.y = {.title = spec.yTitle.empty() ? spec.y : spec.yTitle, .range = {}};
  for (std::size_t f = 0; f < verified.families.size(); ++f)
    for (std::size_t m = 0; m < verified.families[f].variants.size(); ++m) {
      const auto& history = outcomes[f][m].history;
      if (!history) continue;
      ChartCurve& curve = chart.curves.emplace_back();
      curve.label = labelOf(verified.families[f], verified.families[f].variants[m]);
      curve.x = evaluate(*history, spec.x);
      curve.y = evaluate(*history, spec.y);
    }
  return chart;
}

}  // namespace

std::vector<std::filesystem::path> drawHistoryCharts(const VerificationCase& verified,
                                                     const CaseOutcomes& outcomes,
                                                     const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> files;
  for (const CurveChartSpec& spec : verified.document.charts) {
    const Chart chart = chartOf(spec, verified, outcomes);
    if (chart.curves.empty()) continue;
    makeDirectory(directory);
    files.push_back(directory / fmt::format("{}-curve-{}.png", verified.name, files.size() + 1));
    drawChart(chart, files.back());
  }
  return files;
}

}  // namespace burnish
