#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/offered_words.h"
#include "engine/core/error.h"
#include "postproc/compare/annotations.h"
#include "postproc/compare/comparison.h"
#include "postproc/compare/comparison_json.h"
#include "postproc/compare/data/compare_data.h"
#include "postproc/compare/data/data_json.h"
#include "postproc/compare/data/data_report.h"
#include "postproc/compare/difference_picture.h"
#include "postproc/compare/junit.h"
#include "postproc/compare/report.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

struct CompareArguments {
  fs::path actual, baseline;
  std::string metric = "ssim";
  std::optional<double> threshold;
  fs::path difference, report;
  std::vector<std::string> accept;
  std::optional<double> relative, absolute;
  std::vector<std::string> tolerances, only, skip;
  fs::path junit, codeQuality;
  std::string annotations;
  bool update = false, json = false;
};

constexpr std::array kMetrics{std::pair{"ssim", Metric::Ssim}, std::pair{"delta-e", Metric::DeltaE}};

PictureRule ruleOf(const CompareArguments& arguments) {
  PictureRule rule;
  rule.metric = chosen("--metric", arguments.metric, kMetrics);
  if (arguments.threshold) rule.threshold = *arguments.threshold;
  if (!(rule.threshold >= 0.0 && rule.threshold <= 1.0))
    throw Error(fmt::format("--threshold: found {}; expected a number from 0 to 1", rule.threshold));
  return rule;
}

void checkDifferenceName(const CompareArguments& arguments) {
  if (arguments.difference.empty()) return;
  if (arguments.difference.extension() != ".png")
    throw Error(fmt::format("--diff: found \"{}\"; expected the name of a picture that ends in .png",
                            arguments.difference.string()));
  requireNotInput("--diff", arguments.difference, {arguments.actual, arguments.baseline});
}

void requireSinglePictures(const CompareArguments& arguments) {
  std::error_code status;
  if (!arguments.difference.empty() && fs::is_directory(arguments.actual, status))
    throw Error(fmt::format("--diff: {} is a directory; expected two pictures, or --report instead",
                            arguments.actual.string()));
}

/// This call, for the page to complete with the names of pictures.
std::string acceptCommand(const CompareArguments& arguments) {
  std::string line = fmt::format("burnish compare {} {}", shellWord(arguments.actual.string()),
                                 shellWord(arguments.baseline.string()));
  if (arguments.metric != "ssim") line += " --metric " + arguments.metric;
  if (arguments.threshold) line += fmt::format(" --threshold {}", *arguments.threshold);
  return line;
}

void writeDifference(const Comparison& comparison, const fs::path& file) {
  if (!isMeasured(comparison)) return;
  writeText(encodePng(differencePicture(readPicture(comparison.actual), readPicture(comparison.baseline))),
            file);
}

void print(const std::vector<Comparison>& comparisons) {
  for (const Comparison& comparison : comparisons)
    if (comparison.verdict != PictureVerdict::Unusable)
      printOut("{}: {}\n", comparison.name, comparison.message);
  if (comparisons.size() == 1) return;
  const auto equal = std::count_if(comparisons.begin(), comparisons.end(), [](const Comparison& each) {
    return each.verdict == PictureVerdict::Equal;
  });
  printOut("{} of {} pictures are equal to their baselines\n", equal, comparisons.size());
}

CaseOutcome caseOutcome(PictureVerdict verdict) {
  if (verdict == PictureVerdict::Unusable) return CaseOutcome::Error;
  return verdict == PictureVerdict::Equal ? CaseOutcome::Passed : CaseOutcome::Failed;
}

CaseOutcome caseOutcome(FieldVerdict verdict) {
  if (verdict == FieldVerdict::Unusable) return CaseOutcome::Error;
  return verdict == FieldVerdict::Equal ? CaseOutcome::Passed : CaseOutcome::Failed;
}

template <class Compared>
ComparedCase caseOf(const std::string& name, const Compared& each) {
  return {name, caseOutcome(each.verdict), verdictName(each.verdict), each.message};
}

ExitCode exitCodeOf(const std::vector<ComparedCase>& cases) {
  const auto has = [&](CaseOutcome outcome) {
    return std::ranges::count(cases, outcome, &ComparedCase::outcome) > 0;
  };
  if (has(CaseOutcome::Error)) return ExitCode::BadInput;
  return has(CaseOutcome::Failed) ? ExitCode::Different : ExitCode::Fine;
}

/// Files for CI services, with a test or an issue for each picture or field.
void writeCases(const CompareArguments& arguments, const std::vector<ComparedCase>& cases) {
  if (!arguments.junit.empty())
    writeText(junitText("burnish compare " + arguments.actual.string(), cases), arguments.junit);
  if (!arguments.codeQuality.empty())
    writeText(codeQualityText(cases, arguments.baseline.generic_string()), arguments.codeQuality);
  if (!arguments.annotations.empty()) printText(githubAnnotations(cases));
}

void checkFileName(const CompareArguments& arguments, const char* option, const fs::path& file,
                   const char* ending) {
  if (file.empty()) return;
  if (file.extension() != ending)
    throw Error(fmt::format("{}: found \"{}\"; expected the name of a file that ends in {}", option,
                            file.string(), ending));
  requireNotInput(option, file, {arguments.actual, arguments.baseline});
}

void checkOutputs(const CompareArguments& arguments) {
  checkFileName(arguments, "--junit", arguments.junit, ".xml");
  checkFileName(arguments, "--code-quality", arguments.codeQuality, ".json");
  checkDifferenceName(arguments);
  requireDirectoryName("--report", arguments.report);
  if (!arguments.report.empty()) requireNoOtherPage(arguments.report);
  if (arguments.annotations.empty()) return;
  chosen("--annotations", arguments.annotations, std::array{std::pair{"github", true}});
  if (arguments.json)
    throw Error("--annotations: found beside --json; both print on standard output: give one of them");
}

constexpr std::array kPictureOptions{"--metric", "--threshold", "--accept"};
constexpr std::array kDataOptions{"--relative", "--absolute", "--tolerance", "--only", "--skip"};

/// Throws `Error` if one of these options was given; what: what they are for.
template <class Options>
void requireUnused(const CLI::App& command, const Options& options, const char* what, const char* found) {
  for (const char* option : options)
    if (command.count(option) > 0)
      throw Error(fmt::format("{}: is for {}; ACTUAL and BASELINE are {}", option, what, found));
}

/// Writes a page, if there is one, before an update, which is left if that fails, or behind it. Returns its name.
fs::path written(std::optional<ReportPage>& report, const fs::path& directory, bool isUpdated) {
  if (!report) return "";
  report->isUpdated = isUpdated;
  return writeReport(*report, directory);
}

ExitCode comparePicturesOf(const CompareArguments& arguments) {
  const PictureRule rule = ruleOf(arguments);
  requireSinglePictures(arguments);
  std::vector<Comparison> comparisons = comparePictures(arguments.actual, arguments.baseline, rule);
  std::vector<std::string> accepted = acceptActual(comparisons, arguments.accept, rule);
  if (!arguments.difference.empty()) writeDifference(comparisons.front(), arguments.difference);
  std::optional<ReportPage> report;  // shows what was before
  if (!arguments.report.empty())
    report = picturePage(comparisons, rule, acceptCommand(arguments), arguments.update);
  const fs::path page = written(report, arguments.report, false);
  if (arguments.update) accepted = acceptActual(comparisons, {"*"}, rule);
  if (arguments.update) written(report, arguments.report, true);
  std::vector<ComparedCase> cases;
  for (const Comparison& comparison : comparisons) cases.push_back(caseOf(comparison.name, comparison));
  writeCases(arguments, cases);
  for (const Comparison& comparison : comparisons)
    if (comparison.verdict == PictureVerdict::Unusable) printError("burnish: {}\n", comparison.message);
  if (arguments.json) {
    printText(comparisonsText(comparisons, rule));
    return exitCodeOf(cases);
  }
  for (const std::string& name : accepted) printOut("{}: accepted as the new baseline\n", name);
  print(comparisons);
  if (!page.empty()) printOut("report: {}\n", page.string());
  return exitCodeOf(cases);
}

/// By what was compared, for the head of the page.
std::string dataReportNote(const CompareArguments& arguments) {
  const Tolerance usual;
  std::string note =
      fmt::format("Tolerances: {} of the largest magnitude", arguments.relative.value_or(usual.relative));
  if (arguments.absolute) note += fmt::format(", {}", *arguments.absolute);
  if (!arguments.tolerances.empty()) note += fmt::format(", {}", fmt::join(arguments.tolerances, ", "));
  return note + ".";
}

DataRule dataRuleOf(const CompareArguments& arguments) {
  DataRule rule{{}, {}, arguments.only, arguments.skip};
  if (arguments.relative) rule.tolerance.relative = *arguments.relative;
  if (arguments.absolute) rule.tolerance.absolute = *arguments.absolute;
  requireTolerance("--relative", rule.tolerance.relative);
  requireTolerance("--absolute", rule.tolerance.absolute);
  for (const std::string& text : arguments.tolerances)
    rule.fields.push_back(fieldToleranceFromText("--tolerance", text));
  return rule;
}

ExitCode compareDataOf(ComparedKind kind, const CompareArguments& arguments) {
  const DataRule rule = dataRuleOf(arguments);
  std::vector<ResultComparison> comparisons =
      compareData(kind, arguments.actual, arguments.baseline, rule, arguments.update);
  const std::string drawn = arguments.difference.empty() ? "" : drawWorst(comparisons, arguments.difference);
  std::optional<ReportPage> report;  // shows what was before
  if (!arguments.report.empty()) report = dataPage(comparisons, dataReportNote(arguments), arguments.update);
  const fs::path page = written(report, arguments.report, false);
  const std::vector<std::string> updated =
      arguments.update ? makeBaseline(comparisons, rule) : std::vector<std::string>();
  if (arguments.update) written(report, arguments.report, true);
  std::vector<ComparedCase> cases;
  for (const auto& [pair, fields] : comparisons)
    for (const FieldComparison& field : fields) cases.push_back(caseOf(fullName(pair, field), field));
  writeCases(arguments, cases);
  if (arguments.json) {
    printText(fieldsText(comparisons));
    return exitCodeOf(cases);
  }
  for (const ComparedCase& each : cases) {
    if (each.outcome == CaseOutcome::Failed && arguments.annotations.empty())
      printOut("{}: {}\n", each.name, each.message);
    if (each.outcome == CaseOutcome::Error) printError("burnish: {}: {}\n", each.name, each.message);
  }
  const auto equal = std::ranges::count(cases, CaseOutcome::Passed, &ComparedCase::outcome);
  for (const std::string& line : updated) printOut("{}\n", line);
  printOut("{} of {} fields{} are equal to the baseline\n", equal, cases.size(),
           kind == ComparedKind::Directory ? fmt::format(" of {} results", comparisons.size()) : "");
  if (!drawn.empty()) printOut("{}: {}\n", arguments.difference.string(), drawn);
  if (!page.empty()) printOut("report: {}\n", page.string());
  return exitCodeOf(cases);
}

ExitCode compare(const CLI::App& command, const CompareArguments& arguments) {
  if (arguments.update && !arguments.accept.empty())
    throw Error("--update: found beside --accept; it accepts everything: give one of them");
  ComparedKind kind = kindOf(arguments.actual, arguments.baseline);
  std::error_code status;
  if ((kind == ComparedKind::Result || kind == ComparedKind::Directory) &&
      fs::is_directory(arguments.actual, status) &&
      std::ranges::any_of(kPictureOptions, [&](const char* option) { return command.count(option) > 0; }))
    kind = ComparedKind::Pictures;  // those in the directories of runs
  checkOutputs(arguments);
  if (kind == ComparedKind::Pictures) {
    requireUnused(command, kDataOptions, "results and VTK files", "pictures");
    return comparePicturesOf(arguments);
  }
  requireUnused(command, kPictureOptions, "pictures", "results or VTK files");
  return compareDataOf(kind, arguments);
}

void addDataOptions(CLI::App& command, CompareArguments& arguments) {
  const Tolerance usual;
  command
      .add_option("--relative", arguments.relative,
                  fmt::format("Of data: differences that are allowed, by the largest magnitude of the field "
                              "in the baseline [{}]",
                              usual.relative))
      ->type_name("R");
  command
      .add_option("--absolute", arguments.absolute,
                  fmt::format("Of data: differences that are allowed in any case [{}]", usual.absolute))
      ->type_name("A");
  const auto addList = [&command](const char* option, std::vector<std::string>& values, const char* type,
                                  const char* help) {
    command.add_option(option, values, help)->expected(1)->take_all()->type_name(type);
  };
  addList("--tolerance", arguments.tolerances, "NAME=R[,A]",
          "Of data: tolerances of a field (* for any part of its name), relative and absolute; may be "
          "repeated");
  addList("--only", arguments.only, "NAME", "Of data: compare this field (* ...) alone; may be repeated");
  addList("--skip", arguments.skip, "NAME", "Of data: leave this field (* ...) out; may be repeated");
  command
      .add_option("--junit", arguments.junit, "Write a test for each picture or field as JUnit XML for CI")
      ->type_name("FILE.xml");
}

}  // namespace

void addCompareCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("compare", "Compare results or pictures with baselines");
  const auto arguments = std::make_shared<CompareArguments>();
  command->footer(
      "Exit codes: 0 all pictures or fields are equal to their baselines, 1 some are not, 2 unusable input.");
  command
      ->add_option("ACTUAL", arguments->actual,
                   "A PNG picture or a directory of such; the directory of a run or the result file in it; a "
                   "file of another program; or a directory of such results")
      ->required();
  command->add_option("BASELINE", arguments->baseline, "What it is to be like, of the same kind")->required();
  CLI::Option* metric =
      command
          ->add_option(
              "--metric", arguments->metric,
              "ssim: structure and colours, or delta-e: colours alone, in the worst window of 13 x 13 "
              "pixels [ssim]")
          ->type_name("NAME");
  offerChoices(*metric, kMetrics);
  command
      ->add_option("--threshold", arguments->threshold,
                   fmt::format("Largest value of the metric that counts as equal, from 0 to 1 [{}]",
                               PictureRule{}.threshold))
      ->type_name("T");
  command
      ->add_option(
          "--diff", arguments->difference,
          "Write a picture of the difference: of two pictures of the same size, or of the field that "
          "differs most, at its worst place")
      ->type_name("DIFF.png");
  command
      ->add_option(
          "--report", arguments->report,
          "Write the page index.html into this directory, which shows every pair of pictures, or every "
          "field, with pictures of those that differ")
      ->type_name("DIR");
  command
      ->add_option("--accept", arguments->accept,
                   "Make the actual picture of this name (* for any part of it) the new baseline; may be "
                   "repeated")
      ->expected(1)
      ->take_all()
      ->type_name("NAME");
  command->add_flag("--update", arguments->update,
                    "Make all that differs the new baselines; the page of --report shows what was before");
  command
      ->add_option("--annotations", arguments->annotations,
                   "github: print what differs as GitHub Actions shows it at a change")
      ->type_name("SERVICE");
  command
      ->add_option("--code-quality", arguments->codeQuality,
                   "Write what differs as a code quality report, which GitLab shows at a merge request")
      ->type_name("FILE.json");
  command->add_flag("--json", arguments->json,
                    "Print a list of one JSON object per pair of pictures or field");
  addDataOptions(*command, *arguments);
  command->callback([&action, arguments, command] {
    action = [arguments, command] { return compare(*command, *arguments); };
  });
}

}  // namespace burnish
