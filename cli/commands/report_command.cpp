#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/jobs/child_process.h"
#include "engine/core/error.h"
#include "postproc/report/report.h"

namespace burnish {
namespace {

struct ReportArguments {
  std::filesystem::path directory;
  std::filesystem::path page;
  ReportOptions options;
  std::string mirror;
};

ExitCode report(ReportArguments arguments) {
  const SignalGuard signals(SecondSignal::Ends);
  if (arguments.page.empty()) arguments.page = arguments.directory / "report.html";
  if (arguments.page.extension() != ".html")
    throw Error(fmt::format("-o: found \"{}\"; expected the name of a page that ends in .html",
                            arguments.page.string()));
  const std::optional<double>& clip = arguments.options.clip;
  if (clip && !(*clip > 50.0 && *clip <= 100.0))
    throw Error(fmt::format("--clip: found {}; expected a percentile above 50, up to 100", *clip));
  if (!arguments.mirror.empty()) arguments.options.mirror = mirrorFromText(arguments.mirror);
  writeReport(arguments.directory, arguments.options, arguments.page);
  printOut("report {}\n", arguments.page.string());
  return ExitCode::Fine;
}

}  // namespace

void addReportCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("report", "Write a page about a run or a study");
  const auto arguments = std::make_shared<ReportArguments>();
  command->add_option("DIR", arguments->directory, "Directory of a run or of a study")->required();
  command->add_option("-o,--output", arguments->page, "Name of the page [DIR/report.html]")
      ->type_name("PAGE.html");
  command
      ->add_option("--field", arguments->options.field,
                   "What the pictures show, as for render [plastic_strain or von_mises]")
      ->type_name("NAME");
  command
      ->add_option("--clip", arguments->options.clip,
                   "End the colours at this percentile and at 100 minus it, as for render [no]")
      ->type_name("P");
  command
      ->add_option("--mirror", arguments->mirror,
                   "Draw also the images of a symmetric part beyond these planes, as for render [no]")
      ->type_name("x[=V],...");
  command->add_flag("!--no-doubts", arguments->options.marksDoubts,
                    "Do not mark pictures of results that the run doubts");
  command
      ->add_option("--frames", arguments->options.frames,
                   fmt::format("Pictures of a run, at most; evenly chosen [{}]", ReportOptions{}.frames))
      ->check(CLI::Range(2, 1000));
  command
      ->add_option("--document", arguments->options.document,
                   "Document of a study [the only Markdown file in DIR]")
      ->type_name("FILE.md");
  command->callback([&action, arguments] { action = [arguments] { return report(*arguments); }; });
}

}  // namespace burnish
