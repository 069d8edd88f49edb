#include "cli/commands/watch_page.h"

#include <fmt/format.h>

#include "cli/commands/plot_chart.h"
#include "engine/core/error.h"
#include "postproc/export/scratch_directory.h"
#include "postproc/text/account_text.h"
#include "postproc/text/page.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

constexpr int kReloadSeconds = 2;

std::string imageUri(const std::string& bytes, const std::string& ending) {
  return ending == ".png" ? pngUri(bytes) : "data:image/svg+xml;base64," + base64(bytes);
}

/// A picture of the run; nothing for one that pages cannot show, or that is not there any more.
std::string pictureElement(const fs::path& picture) {
  const std::string ending = picture.extension().string();
  if (ending != ".png" && ending != ".svg") return "";
  try {
    const std::string name = escaped(picture.filename().string());
    return fmt::format("<figure><img alt=\"{}\" src=\"{}\"><figcaption>{}</figcaption></figure>\n", name,
                       imageUri(readText(picture), ending), name);
  } catch (const Error&) {
    return "";
  }
}

std::string chartElement(const fs::path& run, const std::string& column) {
  try {
    PlotArguments arguments;
    arguments.histories = {run};
    arguments.y = {column};
    Chart chart = chartOf(arguments).chart;
    chart.legend = false;
    chart.size = {540, 300};
    const ScratchDirectory scratch;
    drawChart(chart, scratch.path() / "chart.svg");
    return fmt::format("<figure><img alt=\"{}\" src=\"{}\"></figure>\n", escaped(column),
                       imageUri(readText(scratch.path() / "chart.svg"), ".svg"));
  } catch (const Error&) {
    return "";  // nothing to draw yet
  }
}

std::string rows(const fs::path& run, const RunState& state) {
  std::vector<std::pair<std::string, std::string>> table{{"Step", std::to_string(state.step)},
                                                         {"Time", fmt::format("{:.6g}", state.time)}};
  if (state.endTime) table.back().second += fmt::format(" of {:.6g}", *state.endTime);
  if (state.residual) table.emplace_back("Residual", fmt::format("{:.2e}", *state.residual));
  table.emplace_back("Frames", state.frames.empty() ? "none yet"
                                                    : fmt::format("{}, the last at t = {:.6g}",
                                                                  state.frames.size(), state.frames.back()));
  table.emplace_back("Directory", run.string());
  std::string text = "<table>\n";
  for (const auto& [name, value] : table)
    text += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", name, escaped(value));
  return text + "</table>\n";
}

std::string endOf(const RunState& state) {
  if (!state.account) return "";
  std::string text = state.account->completed ? "<p>The run has come to its end.</p>\n"
                                              : fmt::format("<p>The run stopped: {}.</p>\n",
                                                            escaped(state.account->stoppedBecause));
  for (const std::string& warning : warningsOf(*state.account))
    text += fmt::format("<p>Warning: {}.</p>\n", escaped(warning));
  return text;
}

}  // namespace

void writeWatchPage(const fs::path& run, const RunState& state, const std::string& column,
                    const fs::path& page) {
  const std::string title = fs::weakly_canonical(run).filename().string();
  const char* judged = !state.account ? "" : state.account->completed ? " class=\"good\"" : " class=\"bad\"";
  const std::string body = fmt::format(
      "<header><h1>{}</h1></header>\n<main><article{}>\n{}{}</article>\n<article>\n{}{}</article></main>\n",
      escaped(title), judged, endOf(state), rows(run, state), pictureElement(state.picture),
      chartElement(run, column));
  writeText(
      htmlText(
          {.title = title,
           .style =
               "th { text-align: left; padding-right: 24px; font-weight: normal; color: var(--soft); }\n",
           .body = body,
           .reloadSeconds = state.account ? 0 : kReloadSeconds}),
      page);
}

}  // namespace burnish
