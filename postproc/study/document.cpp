#include "postproc/study/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/version.h"
#include "postproc/study/claims.h"
#include "postproc/study/figures/figures.h"
#include "postproc/study/measures.h"
#include "postproc/study/run_data.h"
#include "postproc/text/markdown.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

std::string paragraph(const std::string& text) {
  return text.empty() ? text : text + (text.ends_with('\n') ? "\n" : "\n\n");
}

std::string verdictLine(const JudgedClaim& claim) {
  return fmt::format("- **{}**: {} ({})\n", verdictText(claim.verdict), claim.text, claim.numbers);
}

bool haveDifferentLabels(const std::vector<const StudyRun*>& runs) {
  std::set<std::string> labels;
  for (const StudyRun* run : runs) labels.insert(run->label);
  return labels.size() == runs.size();
}

/// The numbers of the summaries that the table of runs shows.
struct SummaryColumn {
  const char* entry;
  const char* title;
};
constexpr std::array kSummaryColumns{SummaryColumn{"steps", "steps"},
                                     SummaryColumn{"cut_backs", "cut-backs"},
                                     SummaryColumn{"smallest_step", "smallest step"},
                                     SummaryColumn{"mean_iterations", "iterations per step"},
                                     SummaryColumn{"max_iterations", "most iterations"},
                                     SummaryColumn{"seconds", "seconds"},
                                     SummaryColumn{"worst_residual", "largest residual"},
                                     SummaryColumn{"smallest_J", "smallest J"},
                                     SummaryColumn{"largest_penetration", "largest penetration"}};

/// Puts a document together, part by part.
class Document {
 public:
  Document(const Study& study, const fs::path& studyDirectory, const DocumentOptions& options)
      : study_(study), directory_(studyDirectory), options_(options) {
    for (const StudyRun& run : study.runs)
      data_.push_back(hasEnded(run, directory_) ? std::optional<RunData>(RunData(run, directory_))
                                                : std::nullopt);
    for (const StatementSpec& statement : study.spec.statements)
      judged_.push_back(judgeClaims(study, statement, directory_, seen_, faults_));
  }

  /// Of measures that were asked for what results do not have, so far.
  const std::vector<std::string>& faults() const { return faults_; }

  std::string text() const {
    const StudySpec& spec = study_.spec;
    std::string text = fmt::format(
        "# {}\n\n{}", spec.title.empty() ? study_.file.stem().string() : spec.title, paragraph(spec.text));
    text += fmt::format("Made by {} from {}. This file is generated; changes to it are lost.\n\n",
                        programName(), study_.file.filename().string());
    text += claims() + runs();
    for (std::size_t k = 0; k < spec.statements.size(); ++k) text += section(spec.statements[k], judged_[k]);
    while (text.ends_with("\n\n")) text.pop_back();
    return text;
  }

 private:
  /// How many claims hold, and those that do not.
  std::string claims() const {
    std::string others;
    std::array<int, 3> total{};
    std::vector<MarkdownColumn> columns{
        {"statement", {}, false}, {"hold", {}}, {"do not hold", {}}, {"cannot be told", {}}};
    for (std::size_t k = 0; k < judged_.size(); ++k) {
      if (judged_[k].empty()) continue;
      const StatementSpec& statement = study_.spec.statements[k];
      const std::string link = fmt::format("[{}](#{})", statement.title, statement.name);
      std::array<int, 3> counts{};
      for (const JudgedClaim& claim : judged_[k]) {
        ++counts[static_cast<std::size_t>(claim.verdict)];
        if (claim.verdict != Verdict::Holds)
          others += fmt::format("- **{}**: {} ({})\n", verdictText(claim.verdict), claim.text, link);
      }
      columns[0].cells.push_back(link);
      for (std::size_t v = 0; v < counts.size(); ++v) {
        columns[v + 1].cells.push_back(std::to_string(counts[v]));
        total[v] += counts[v];
      }
    }
    if (columns[0].cells.empty()) return {};
    std::string title;
    for (const Verdict verdict : {Verdict::Holds, Verdict::DoesNotHold, Verdict::CannotBeTold})
      title += fmt::format("{}{} {}", title.empty() ? "" : ", ", total[static_cast<std::size_t>(verdict)],
                           countedText(verdict, total[static_cast<std::size_t>(verdict)]));
    return fmt::format("## Claims\n\nOf the claims, {}.\n\n{}{}\n{}", title, doubtSentence(),
                       markdownTable(columns), others.empty() ? "" : others + "\n");
  }

  static std::string countedText(Verdict verdict, int count) {
    if (count == 1 || verdict == Verdict::CannotBeTold) return verdictText(verdict);
    return verdict == Verdict::Holds ? "hold" : "do not hold";
  }

  /// How the runs went.
  std::string runs() const {
    Footnotes notes;
    std::vector<MarkdownColumn> columns{{"run", {}, false}, {"came to its end", {}, false}};
    for (std::size_t k = 0; k < data_.size(); ++k) {
      columns[0].cells.push_back(study_.runs[k].name);
      columns[1].cells.push_back(endText(data_[k], notes));
    }
    for (const SummaryColumn& column : kSummaryColumns)
      columns.push_back({column.title, columnTexts(numbers(column.entry))});
    columns.push_back({"doubtful from t", doubtTexts(notes)});
    return fmt::format("## Runs\n\n{}\n{}{}", markdownTable(columns), paragraph(notes.text()), settings());
  }

  /// Since when each run is doubtful, and why.
  std::vector<std::string> doubtTexts(Footnotes& notes) const {
    std::vector<std::string> texts;
    for (const auto& data : data_) {
      std::string text;
      if (data)
        for (const DoubtRecord& doubt : data->summary().doubts)
          text += (text.empty() ? "" : ", ") + plainNumber(doubt.firstTime) + notes.mark(doubt.what);
      texts.push_back(text);
    }
    return texts;
  }

  /// What is to be known of the runs before their claims are read.
  std::string doubtSentence() const {
    const auto count = std::count_if(
        data_.begin(), data_.end(), [](const auto& data) { return data && !data->summary().doubts.empty(); });
    if (count == 0) return {};
    return fmt::format(
        "{} of the {} runs are doubtful from some time on (the table of runs says from when, and why): do "
        "not trust numbers and claims about later times. Where a table shows such a run, a note says so.\n\n",
        count, data_.size());
  }

  static std::string endText(const std::optional<RunData>& data, Footnotes& notes) {
    if (!data) return "no results";
    const auto stopped = data->stoppedAt();
    return stopped ? stoppedText(*stopped) + notes.mark(data->summary().stoppedBecause) : "yes";
  }

  std::vector<std::optional<double>> numbers(const std::string& entry) const {
    std::vector<std::optional<double>> values;
    for (const auto& data : data_)
      values.push_back(data ? std::optional<double>(data->number(entry)) : std::nullopt);
    return values;
  }

  std::string settings() const {
    return fmt::format("Relative tolerance of the force residual: {}. Contact parameter: {}.\n\n",
                       valueOrRange("tolerance"), valueOrRange("contact_parameter"));
  }

  /// The value that all runs share, or the smallest and the largest one.
  std::string valueOrRange(const std::string& entry) const {
    std::vector<double> known;
    for (const auto& value : numbers(entry))
      if (value) known.push_back(*value);
    if (known.empty()) return "—";
    const auto [low, high] = std::minmax_element(known.begin(), known.end());
    const std::string from = plainNumber(*low), to = plainNumber(*high);
    return from == to ? from : fmt::format("{} to {}", from, to);
  }

  std::string section(const StatementSpec& statement, const std::vector<JudgedClaim>& claims) const {
    std::string text = fmt::format("<a id=\"{}\"></a>\n\n## {}\n\n{}", statement.name, statement.title,
                                   paragraph(statement.text));
    if (!statement.runs.empty() && !statement.measures.empty()) text += table(statement) + "\n";
    for (const JudgedClaim& claim : claims) text += verdictLine(claim);
    if (!claims.empty()) text += "\n";
    for (const std::string& name : statement.figures) text += figure(name) + "\n";
    return text;
  }

  std::string table(const StatementSpec& statement) const {
    const auto runs = study_.matching(statement.runs);
    std::vector<MarkdownColumn> columns{{"run", {}, false}};
    const bool labelsDiffer = haveDifferentLabels(runs);
    Footnotes notes;
    for (const StudyRun* run : runs)
      columns[0].cells.push_back((labelsDiffer ? run->label : run->name) + doubtMark(*run, notes));
    for (const MeasureSpec& measure : statement.measures) {
      std::vector<std::optional<double>> values;
      std::vector<std::string> marks;
      for (const StudyRun* run : runs) {
        const Measured measured =
            measuredOrFault(study_, statement, *run, measure, directory_, seen_, faults_);
        values.push_back(measured.value);
        marks.push_back(notes.mark(measured.note));
      }
      std::vector<std::string> cells = columnTexts(values);
      for (std::size_t k = 0; k < cells.size(); ++k) cells[k] += marks[k];
      columns.push_back({measure.title, std::move(cells)});
    }
    const std::string below = notes.text();
    return markdownTable(columns) + (below.empty() ? "" : "\n" + below);
  }

  std::string doubtMark(const StudyRun& run, Footnotes& notes) const {
    const auto& data = data_[static_cast<std::size_t>(&run - study_.runs.data())];
    if (!data || data->summary().doubts.empty()) return {};
    return notes.mark(
        fmt::format("doubtful from t = {} on", plainNumber(data->summary().doubts.front().firstTime)));
  }

  std::string figure(const std::string& name) const {
    const auto& figures = study_.spec.figures;
    const auto found = std::find_if(figures.begin(), figures.end(),
                                    [&](const FigureSpec& figure) { return figure.name == name; });
    if (found == figures.end())
      throw Error(fmt::format("{}: there is no figure \"{}\"", study_.file.string(), name));
    const fs::path picture = directory_ / "figures" / (name + ".png");
    if (!fs::exists(picture)) return fmt::format("(The figure {} has not been drawn.)\n", name);
    const std::string clip = clipText(*found);
    const std::string caption = found->caption.empty() || clip.empty()
                                    ? found->caption + clip
                                    : fmt::format("{} ({})", found->caption, clip);
    return markdownPicture(shown(picture), caption);
  }

  /// Contour pictures with a common scale do not say themselves that their colours are clipped.
  static std::string clipText(const FigureSpec& figure) {
    const auto clip = clipOf(figure);
    if (!clip) return {};
    return fmt::format("Colours end at the percentiles {} and {} of the values.", plainNumber(100.0 - *clip),
                       plainNumber(*clip));
  }

  /// Where the document finds a picture, relative to its own directory.
  fs::path shown(const fs::path& picture) const {
    fs::path place = picture;
    if (!options_.gallery.empty()) {
      place = options_.gallery / picture.filename();
      writeText(readText(picture), place);
    }
    return fs::absolute(place).lexically_normal().lexically_relative(
        fs::absolute(options_.file).lexically_normal().parent_path());
  }

  const Study& study_;
  const fs::path& directory_;
  const DocumentOptions& options_;
  mutable SeenProfiles seen_;
  mutable std::vector<std::string> faults_;
  std::vector<std::optional<RunData>> data_;      ///< of each run of the study
  std::vector<std::vector<JudgedClaim>> judged_;  ///< of each statement
};

}  // namespace

std::vector<std::string> writeDocument(const Study& study, const fs::path& studyDirectory,
                                       const DocumentOptions& options) {
  const Document document(study, studyDirectory, options);
  writeText(document.text(), options.file);
  return document.faults();
}

}  // namespace burnish
