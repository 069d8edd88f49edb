#include "postproc/study/verification/history_chart.h"

#include <fmt/format.h>

#include <string>

#include "engine/core/error.h"
#include "engine/results/result_reader.h"
#include "postproc/draw/chart/chart.h"
#include "postproc/study/evidence/expression.h"
#include "postproc/study/evidence/quantity.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

/// The quadrature points of a contact face at the end of a run as rows, in columns time, x, y, pressure, gap, with
/// friction friction_x and friction_y.
HistoryTable pointsOfFace(const std::filesystem::path& run, const std::string& contact) {
  const ResultReader result(run);
  const FrameRecord frame = result.frame(result.numFrames() - 1);
  for (const ContactRecord& record : frame.contact) {
    if (record.tool != contact && record.pair != contact) continue;
    HistoryTable table{result.file(), {}, {}};
    const auto add = [&](const char* column, const Eigen::VectorXd& values) {
      table.columns.emplace_back(column);
      table.values.emplace_back(values.begin(), values.end());
    };
    add("time", Eigen::VectorXd::Constant(record.quadraturePressure.size(), frame.time));
    add("x", record.quadraturePoints.row(0));
    add("y", record.quadraturePoints.row(1));
    add("pressure", record.quadraturePressure);
    add("gap", record.quadratureGap);
    if (record.quadratureFriction.size() > 0) {
      add("friction_x", record.quadratureFriction.row(0));
      add("friction_y", record.quadratureFriction.row(1));
    }
    return table;
  }
  throw Error(fmt::format("{}: no tool or pair of faces in contact has the name {}", result.file().string(),
                          contact));
}

Chart chartOf(const CurveChartSpec& spec, const VerificationCase& verified, const CaseOutcomes& outcomes) {
  Chart chart;
  chart.size = {1200, 1100};  // room for the legend
  chart.x = {.title = spec.xTitle.empty() ? spec.x : spec.xTitle, .range = spec.xRange};
  chart.y = {.title = spec.yTitle.empty() ? spec.y : spec.yTitle, .range = spec.yRange};
  ChartCurve theory;
  for (std::size_t f = 0; f < verified.families.size(); ++f)
    for (std::size_t m = 0; m < verified.families[f].variants.size(); ++m) {
      const auto& history = outcomes[f][m].history;
      const bool finest = m + 1 == verified.families[f].variants.size();
      if (!history || (!spec.contact.empty() && !finest)) continue;
      ChartCurve& curve = chart.curves.emplace_back();
      const CaseVariant& variant = verified.families[f].variants[m];
      const HistoryTable rows =
          spec.contact.empty() ? *history : pointsOfFace(history->path.parent_path(), spec.contact);
      const auto values = [&](const std::string& formula) {
        return evaluate(withDefinitions(rows, formula, variant.definitions), formula);
      };
      const std::string& family = verified.families[f].name;
      curve.label = spec.contact.empty() ? labelOf(verified.families[f], variant)
                    : family.empty()     ? "computed"
                                         : family;
      curve.x = values(spec.x);
      curve.y = values(spec.y);
      if (!spec.exact.empty())
        theory = {"exact", curve.x, values(spec.exact), CurveStyle{kBlackCurve, 1, -1}};
    }
  if (!theory.x.empty()) chart.curves.push_back(std::move(theory));
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
