#include "postproc/report/study_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/version.h"
#include "postproc/draw/contour/contour_series.h"
#include "postproc/draw/contour/frame_pictures.h"
#include "postproc/export/scratch_directory.h"
#include "postproc/report/html_parts.h"
#include "postproc/report/run_facts.h"
#include "postproc/report/run_record.h"
#include "postproc/report/run_warnings.h"
#include "postproc/study/claims.h"
#include "postproc/text/markdown.h"
#include "postproc/text/markdown_html.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

constexpr std::array<int, 2> kSmallPictureSize{640, 320};
constexpr double kSmallTextSize = 13.0;

std::set<fs::path> filesIn(const fs::path& directory, const std::string& ending) {
  std::set<fs::path> files;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(directory, missing))
    if (entry.path().extension() == ending) files.insert(entry.path());
  return files;
}

/// Names of the runs in the order of runs.csv, then those that are not in it.
std::vector<std::string> runNames(const fs::path& directory) {
  std::set<std::string> others;
  for (const auto& entry : fs::directory_iterator(directory / "runs"))
    if (entry.is_directory()) others.insert(entry.path().filename().string());
  std::vector<std::string> names;
  if (fs::exists(directory / "runs.csv")) {
    std::istringstream rows(readText(directory / "runs.csv"));
    for (std::string row; std::getline(rows, row);)
      if (const std::string name = row.substr(0, row.find(',')); others.erase(name) > 0)
        names.push_back(name);
  }
  names.insert(names.end(), others.begin(), others.end());
  return names;
}

/// Pictures of figures, without their panels NAME_*.png.
std::set<fs::path> figureFiles(const fs::path& directory) {
  const std::set<fs::path> files = filesIn(directory / "figures", ".png");
  std::set<fs::path> figures;
  for (const fs::path& file : files) {
    const std::string stem = file.stem().string();
    bool isPanel = false;
    for (std::size_t at = stem.find('_'); at != std::string::npos; at = stem.find('_', at + 1))
      isPanel |= files.contains(file.parent_path() / (stem.substr(0, at) + ".png"));
    if (!isPanel) figures.insert(file);
  }
  return figures;
}

fs::path documentFile(const fs::path& directory, const fs::path& wanted) {
  if (!wanted.empty()) return wanted;
  const std::set<fs::path> documents = filesIn(directory, ".md");
  return documents.size() == 1 ? *documents.begin() : fs::path();
}

/// "# TITLE" of the first line, or the name of the directory.
std::string titleOf(const std::string& document, const fs::path& directory) {
  if (document.starts_with("# ")) return document.substr(2, document.find('\n') - 2);
  return fs::weakly_canonical(directory).filename().string();
}

/// Gives words in bold type a class.
std::string withClass(std::string html, const std::string& words, const std::string& name) {
  const std::string plain = "<strong>" + words + "<",
                    marked = "<strong class=\"" + name + "\">" + words + "<";
  for (std::size_t at = 0; (at = html.find(plain, at)) != std::string::npos; at += marked.size())
    html.replace(at, plain.size(), marked);
  return html;
}

/// A run, or why it cannot be read.
struct StudyEntry {
  std::string name;
  std::optional<RunRecord> run;
  std::vector<std::string> warnings;
};

StudyEntry entryOf(const fs::path& directory, const std::string& name) {
  StudyEntry entry{name, {}, {}};
  try {
    entry.run = readRun(directory / "runs" / name);
    entry.warnings = runWarnings(*entry.run);
  } catch (const Error& error) {
    entry.warnings = {error.what()};
  }
  return entry;
}

/// Puts the page together, part by part.
class StudyPage {
 public:
  StudyPage(const fs::path& directory, const ReportOptions& options)
      : options_(options), figures_(figureFiles(directory)) {
    const fs::path file = documentFile(directory, options.document);
    if (!file.empty()) document_ = readText(file);
    title_ = titleOf(document_, directory);
    for (const std::string& name : runNames(directory)) entries_.push_back(entryOf(directory, name));
  }

  HtmlPage page() {
    const std::string document = documentCard(), others = otherFigures();
    std::string body = fmt::format("<header>\n<h1>{}</h1>\n<p>Report of a study of {} runs by {}.</p>\n",
                                   escaped(title_), entries_.size(), escaped(programName()));
    std::vector<std::pair<std::string, std::string>> parts{{"runs", "Runs"}};
    if (!document.empty()) parts.emplace_back("document", "Statements and figures");
    if (!others.empty()) parts.emplace_back("figures", document.empty() ? "Figures" : "Other figures");
    parts.emplace_back("each-run", "Each run");
    body += htmlContents(parts) + "</header>\n<main>\n" + runsCard() + document;
    if (!others.empty()) body += htmlCard("figures", parts[parts.size() - 2].second, others);
    body += "<h2 id=\"each-run\">Each run</h2>\n";
    for (const StudyEntry& entry : entries_) body += runCard(entry);
    return {title_, {}, body + "</main>\n", {}};
  }

 private:
  std::string runsCard() const {
    constexpr std::array<std::pair<const char*, const char*>, 9> entries{
        {{"end_time", "end"},
         {"steps", "steps"},
         {"cut_backs", "cut-backs"},
         {"mean_iterations", "iterations per step"},
         {"max_iterations", "most iterations"},
         {"seconds", "seconds"},
         {"worst_residual", "largest residual"},
         {"smallest_J", "smallest J"},
         {"largest_penetration", "largest penetration"}}};
    std::vector<HtmlColumn> columns{{"run", {}, false}, {"state", {}, false}, {"warnings", {}}};
    for (const StudyEntry& entry : entries_) {
      columns[0].cells.push_back(fmt::format("<a href=\"#run-{0}\">{0}</a>", escaped(entry.name)));
      columns[1].cells.push_back(entry.run ? entry.run->state() : "no results");
      columns[2].cells.push_back(entry.warnings.empty() ? "" : std::to_string(entry.warnings.size()));
    }
    std::vector<std::map<std::string, double>> numbers;  // of a run that has ended
    for (const StudyEntry& entry : entries_)
      numbers.push_back(entry.run && entry.run->account ? numbersOf(*entry.run->account)
                                                        : std::map<std::string, double>{});
    for (const auto& [name, title] : entries) {
      std::vector<std::optional<double>> values;
      for (const auto& known : numbers)
        values.push_back(known.contains(name) ? std::optional(known.at(name)) : std::nullopt);
      columns.push_back({title, columnTexts(values)});
    }
    return htmlCard("runs", "Runs", htmlTable(columns));
  }

  /// The document with its pictures; the table of runs stands above.
  std::string documentCard() {
    if (document_.empty()) return {};
    const std::size_t heading = document_.starts_with("# ") ? document_.find('\n') : 0;
    const std::string text = withoutSection(document_.substr(std::min(heading, document_.size())), "Runs");
    std::string html =
        markdownHtml(text, [this](const std::string& address) { return documentPicture(address); });
    html = withClass(std::move(html), verdictText(Verdict::Holds), "holds");
    html = withClass(std::move(html), verdictText(Verdict::DoesNotHold), "does-not-hold");
    return fmt::format("<article id=\"document\">\n{}</article>\n", html);
  }

  /// The figure of that file name, which is in the study's directory also where the document shows a copy.
  std::string documentPicture(const std::string& address) {
    const std::string name = fs::path(address).filename().string();
    const auto found = std::find_if(figures_.begin(), figures_.end(),
                                    [&](const fs::path& file) { return file.filename() == name; });
    if (found == figures_.end()) return "data:,";
    shown_.insert(*found);
    return pngUri(readText(*found));
  }

  std::string otherFigures() const {
    std::string text;
    for (const fs::path& file : figures_)
      if (!shown_.contains(file))
        text += fmt::format("<figure><figcaption>{0}</figcaption>{1}</figure>\n",
                            escaped(file.stem().string()), htmlPicture(readText(file), file.stem().string()));
    return text;
  }

  std::string runCard(const StudyEntry& entry) const {
    std::string html = entry.warnings.empty() ? "" : htmlWarnings(entry.warnings);
    if (entry.run) {
      html += fmt::format("<div class=\"pair\">{}{}</div>\n", htmlFacts(runFacts(*entry.run)),
                          lastPicture(*entry.run));
      html += fmt::format("<details><summary>Settings</summary><pre>{}</pre></details>\n",
                          escaped(entry.run->result.model().sceneYaml));
    }
    html += "<p><a href=\"#runs\">all runs</a></p>\n";
    return htmlCard("run-" + entry.name, entry.name, html, entry.warnings.empty() ? "good" : "bad");
  }

  /// The last frame, or why there is no picture of it; the others are shown all the same.
  std::string lastPicture(const RunRecord& run) const {
    const int frames = run.result.numFrames();
    if (frames == 0) return "<div class=\"absent\">There is no frame yet.</div>";
    try {
      return drawnPicture(run, run.result.frame(frames - 1));
    } catch (const Error& error) {
      return fmt::format("<div class=\"absent\">{}</div>", escaped(error.what()));
    }
  }

  std::string drawnPicture(const RunRecord& run, const FrameRecord& frame) const {
    ContourOptions options = contourOptions(options_.picture, run.result, frame);
    options.size = kSmallPictureSize;
    options.textSize = options.theme.textSize * kSmallTextSize;
    options.title = "";
    return htmlPicture(framePicture(run.result, frame, options, scratch_.path()),
                       fmt::format("{} of {} at t = {}", options.field, run.name, plainNumber(frame.time)));
  }

  const ReportOptions& options_;
  std::set<fs::path> figures_, shown_;  ///< all; those in the document
  std::string document_, title_;
  std::vector<StudyEntry> entries_;
  ScratchDirectory scratch_;
};

}  // namespace

HtmlPage studyPage(const fs::path& directory, const ReportOptions& options) {
  return StudyPage(directory, options).page();
}

}  // namespace burnish
