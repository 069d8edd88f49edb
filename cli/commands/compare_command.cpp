#include <fmt/format.h>

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
#include "engine/core/error.h"
#include "postproc/compare/comparison.h"
#include "postproc/compare/comparison_json.h"
#include "postproc/compare/difference_picture.h"
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
  bool json = false;
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
  std::error_code status;
  if (fs::is_directory(arguments.actual, status))
    throw Error(fmt::format("--diff: {} is a directory; expected two pictures, or --report instead",
                            arguments.actual.string()));
  requireNotInput("--diff", arguments.difference, {arguments.actual, arguments.baseline});
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

ExitCode exitCodeOf(const std::vector<Comparison>& comparisons) {
  ExitCode code = ExitCode::Fine;
  for (const Comparison& comparison : comparisons) {
    if (comparison.verdict == PictureVerdict::Unusable) return ExitCode::BadInput;
    if (comparison.verdict != PictureVerdict::Equal) code = ExitCode::Different;
  }
  return code;
}

ExitCode compare(const CompareArguments& arguments) {
  const PictureRule rule = ruleOf(arguments);
  checkDifferenceName(arguments);
  std::vector<Comparison> comparisons = comparePictures(arguments.actual, arguments.baseline, rule);
  const std::vector<std::string> accepted = acceptActual(comparisons, arguments.accept, rule);
  if (!arguments.difference.empty()) writeDifference(comparisons.front(), arguments.difference);
  fs::path page;
  if (!arguments.report.empty())
    page = writeReport(comparisons, rule, acceptCommand(arguments), arguments.report);
  for (const Comparison& comparison : comparisons)
    if (comparison.verdict == PictureVerdict::Unusable) printError("burnish: {}\n", comparison.message);
  if (arguments.json) {
    printText(comparisonsText(comparisons, rule));
    return exitCodeOf(comparisons);
  }
  for (const std::string& name : accepted) printOut("{}: accepted as the new baseline\n", name);
  print(comparisons);
  if (!page.empty()) printOut("report: {}\n", page.string());
  return exitCodeOf(comparisons);
}

}  // namespace

void addCompareCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("compare", "Compare pictures with baselines");
  const auto arguments = std::make_shared<CompareArguments>();
  command->footer(
      "Exit codes: 0 all pictures are equal to their baselines, 1 some are not, 2 unusable input.");
  command->add_option("ACTUAL", arguments->actual, "A PNG picture, or a directory of such")->required();
  command->add_option("BASELINE", arguments->baseline, "What it is to look like: a picture or a directory")
      ->required();
  command
      ->add_option("--metric", arguments->metric,
                   "ssim: structure and colours, or delta-e: colours alone, in the worst window of 13 x 13 "
                   "pixels [ssim]")
      ->type_name("NAME");
  command
      ->add_option("--threshold", arguments->threshold,
                   fmt::format("Largest value of the metric that counts as equal, from 0 to 1 [{}]",
                               PictureRule{}.threshold))
      ->type_name("T");
  command
      ->add_option("--diff", arguments->difference,
                   "Write a picture of the difference; for single pictures of the same size")
      ->type_name("DIFF.png");
  command
      ->add_option("--report", arguments->report,
                   "Write the page index.html into this directory, which shows every pair")
      ->type_name("DIR");
  command
      ->add_option("--accept", arguments->accept,
                   "Make the actual picture of this name (* for any part of it) the new baseline; may be "
                   "repeated")
      ->expected(1)
      ->take_all()
      ->type_name("NAME");
  command->add_flag("--json", arguments->json, "Print a list of one JSON object per pair");
  command->callback([&action, arguments] { action = [arguments] { return compare(*arguments); }; });
}

}  // namespace burnish
