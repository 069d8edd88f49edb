#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "cli/command.h"
#include "cli/commands/picture_options.h"
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
  DeclaredOptions picture;
};

ExitCode report(ReportArguments arguments) {
  const SignalGuard signals(SecondSignal::Ends);
  if (arguments.page.empty()) arguments.page = arguments.directory / "report.html";
  if (arguments.page.extension() != ".html")
    throw Error(fmt::format("-o: found \"{}\"; expected the name of a page that ends in .html",
                            arguments.page.string()));
  readPicture(arguments.picture, arguments.options.picture, {});
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
      ->add_option("--field", arguments->options.picture.field,
                   "What the pictures show, as for render [plastic_strain or von_mises]")
      ->type_name("FIELD");
  addPictureOptions(*command, arguments->picture, PanelOptions{});
  command
      ->add_option("--frames", arguments->options.frames,
                   fmt::format("Pictures of a run, at most; evenly chosen [{}]", ReportOptions{}.frames))
      ->check(CLI::Range(2, 1000));
  command->add_flag("--turn", arguments->options.turn,
                    "Of a run: with the body, which can be turned, zoomed and cut");
  command
      ->add_option("--document", arguments->options.document,
                   "Document of a study [the only Markdown file in DIR]")
      ->type_name("FILE.md");
  command->callback([&action, arguments] { action = [arguments] { return report(*arguments); }; });
}

}  // namespace burnish
