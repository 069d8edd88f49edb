#include "postproc/report/run_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "engine/core/version.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/contour_series.h"
#include "postproc/draw/contour/frame_pictures.h"
#include "postproc/export/scratch_directory.h"
#include "postproc/probe/probed_run.h"
#include "postproc/report/html_parts.h"
#include "postproc/report/run_facts.h"
#include "postproc/report/run_record.h"
#include "postproc/report/run_warnings.h"
#include "postproc/scene/scene_document.h"
#include "postproc/text/account_text.h"
#include "postproc/text/markdown.h"
#include "postproc/view/view.h"

namespace burnish {
namespace {

constexpr std::array<int, 2> kPictureSize{960, 480};
constexpr std::array<int, 2> kProbeSize{640, 400};
constexpr double kTextSize = 18.0;

ContourOptions pictureOptions(const RunRecord& run, const ReportOptions& report,
                              const std::vector<int>& frames) {
  ContourOptions options = contourOptions(report.picture, run.result, run.result.frame(frames.back()));
  options.size = kPictureSize;
  options.textSize = options.theme.textSize * kTextSize;
  options.title = "";
  options.time = false;  // the page says it
  return withCommonView(options, run.result, frames, frames);
}

std::string scaleNote(std::optional<double> clip, int dim) {
  const std::string text = "All frames have one colour scale";
  if (!clip) return text + ".";
  return fmt::format("{}; its {}, the lowest and the highest of all frames.", text, clipNote(*clip, dim));
}

/// All pictures on one place, of which the slider shows one; the last at first.
std::string pictures(const RunRecord& run, const ReportOptions& report) {
  const int count = run.result.numFrames();
  if (count == 0) return "<p>There is no frame yet.</p>\n";
  const std::vector<int> frames = evenlyChosen(count, report.frames);
  const ContourOptions options = pictureOptions(run, report, frames);
  const ScratchDirectory scratch;
  std::string images, last;
  for (const int number : frames) {
    const FrameRecord frame = run.result.frame(number);
    last = fmt::format("t = {} (frame {} of {}, step {})", plainNumber(frame.time), number + 1, count,
                       frame.step);
    images +=
        htmlPicture(framePicture(run.result, frame, options, scratch.path()), options.field + ", " + last,
                    fmt::format(" data-time=\"{}\"{}", last, number == frames.back() ? "" : " hidden"));
  }
  const auto most = frames.size() - 1;
  return fmt::format(
      "<div class=\"control\"><input type=\"range\" id=\"frame\" min=\"0\" max=\"{0}\" value=\"{0}\" "
      "aria-label=\"Frame\"><output id=\"time\" for=\"frame\">{1}</output></div>\n<div "
      "id=\"frames\">\n{2}</div>\n<p>{3}</p>\n",
      most, last, images, scaleNote(report.picture.clip, run.result.model().dim));
}

/// None of a result without a scene that this program reads.
std::vector<SceneProbe> probesOf(const std::filesystem::path& directory) {
  try {
    return readResultDocument(directory).probes;
  } catch (const Error&) {
    return {};
  }
}

/// Charts of the probes of the scene; one that cannot be made says why.
std::string probes(const RunRecord& run, const std::vector<SceneProbe>& specs) {
  std::vector<CaptionedChart> charts;
  std::string html;
  for (const SceneProbe& spec : specs) {
    try {
      charts.push_back({spec.name, chartOf(spec, probedRuns(run.result, spec, spec.times))});
      charts.back().chart.size = kProbeSize;
    } catch (const Interrupted&) {
      throw;
    } catch (const Error& error) {
      html += fmt::format("<p>{}: {}.</p>\n", escaped(spec.name), escaped(error.what()));
    }
  }
  return htmlCharts(charts) + html;
}

/// The page to turn, of the same frames and the same field.
HtmlPage turnedPage(const RunRecord& run, const ReportOptions& report, const std::filesystem::path& html) {
  const std::vector<int> frames = evenlyChosen(run.result.numFrames(), report.frames);
  ViewOptions options;
  static_cast<PictureOptions&>(options) = report.picture;
  options.cut.reset();  // the person at the page cuts
  options.slice.reset();
  options.arrows = ArrowField::None;
  options.controlNet = false;
  if (options.theme.name != ChosenTheme().name) options.pageTheme = options.theme;
  const std::string field = contourOptions(report.picture, run.result, run.result.frame(frames.back())).field;
  return viewPage(run.result, frames, {field}, options, html);
}

/// Seconds by part of the program, with a bar for the share.
std::string timings(const RunRecord& run) {
  const double total = run.account ? run.account->timings.total : 0.0;
  if (!(total > 0.0)) return "<p>They are known when the run has ended.</p>\n";
  std::vector<HtmlColumn> columns{{"part", {}, false}, {"seconds", {}}, {"share", {}}, {"", {}, false}};
  const auto add = [&](const std::string& name, double seconds) {
    const double percent = std::clamp(100.0 * seconds / total, 0.0, 100.0);
    columns[0].cells.push_back(name);
    columns[1].cells.push_back(fmt::format("{:.3f}", seconds));
    columns[2].cells.push_back(fmt::format("{:.1f} %", percent));
    columns[3].cells.push_back(fmt::format("<div class=\"bar\" style=\"width:{:.1f}%\"></div>", percent));
  };
  for (const auto& [name, seconds] : timingsTable(*run.account)) add(name, std::max(0.0, seconds));
  add("altogether", total);
  return htmlTable(columns);
}

}  // namespace

HtmlPage runPage(const std::filesystem::path& directory, const ReportOptions& options,
                 const std::filesystem::path& html) {
  const RunRecord run = readRun(directory);
  const ModelRecord& model = run.result.model();
  const std::vector<std::string> warnings = runWarnings(run);
  const std::string title = model.title.empty() ? run.name : model.title;
  std::string body = fmt::format("<header>\n<h1>{}</h1>\n<p>Report of the run {} by {}.</p>\n",
                                 escaped(title), escaped(run.name), escaped(programName()));
  const std::vector<SceneProbe> specs = probesOf(directory);
  std::optional<HtmlPage> turned;
  if (options.turn && run.result.numFrames() > 0) turned = turnedPage(run, options, html);
  std::vector<std::pair<std::string, std::string>> parts{
      {"warnings", "Warnings"},       {"summary", "Summary"},
      {"pictures", "Pictures"},       {"turned", "Body"},
      {"probes", "Probes"},           {"charts", "Charts"},
      {"convergence", "Convergence"}, {"timings", "Timings"},
      {"settings", "Settings"}};
  if (specs.empty()) std::erase(parts, std::pair<std::string, std::string>("probes", "Probes"));
  if (!turned) std::erase(parts, std::pair<std::string, std::string>("turned", "Body"));
  body += htmlContents(parts);
  body += "</header>\n<main>\n";
  body += htmlCard("warnings", "Warnings", htmlWarnings(warnings), warnings.empty() ? "good" : "bad");
  body += htmlCard("summary", "Summary", htmlFacts(runFacts(run)));
  body += htmlCard("pictures", "Pictures", pictures(run, options));
  if (turned) body += htmlCard("turned", "Body", framed(*turned, "The body to be turned, zoomed and cut"));
  if (!specs.empty()) body += htmlCard("probes", "Probes", probes(run, specs));
  body += htmlCard("charts", "Charts", htmlCharts(stateCharts(run)));
  body += htmlCard("convergence", "Convergence", htmlCharts(convergenceCharts(run)));
  body += htmlCard("timings", "Timings", timings(run));
  body += htmlCard("settings", "Settings",
                   fmt::format("<p>The scene with every default filled in.</p>\n<pre>{}</pre>\n",
                               escaped(model.sceneYaml)));
  HtmlPage page{title, {}, body + "</main>\n"};
  if (turned) page.framedHashes = {turned->scriptHash};
  return page;
}

}  // namespace burnish
