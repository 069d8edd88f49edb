#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/commands/probe_chart.h"
#include "cli/console.h"
#include "cli/jobs/child_process.h"
#include "postproc/probe/probe_spec.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

/// To a file, which is none of those that were read, or with - to standard output.
void writeNumbers(const std::string& table, const std::string& file,
                  const std::vector<std::filesystem::path>& inputs) {
  if (file == "-") return printText(table);
  requireNotInput("--numbers", file, inputs);
  makeDirectoryOf(file);
  writeText(table, file);
}

ExitCode probe(const ProbeArguments& arguments, ChartOutputs outputs, const std::string& numbers) {
  const SignalGuard signals(SecondSignal::Ends);
  if (!arguments.section.empty() && (numbers.empty() || !outputs.picture.empty() || !outputs.csv.empty()))
    throw Error(
        "--section: a section has numbers and no curve; expected --numbers FILE.csv|- without -o and --csv");
  std::vector<ProbeSource> results;
  std::vector<std::filesystem::path> inputs;
  for (const std::filesystem::path& result : arguments.results)
    inputs.push_back(results.emplace_back(probeSource(result)).file);
  if (!numbers.empty() && outputs.picture.empty() && outputs.csv.empty()) {
    writeNumbers(numbersTable(arguments, results), numbers, inputs);
    return ExitCode::Fine;
  }
  if (outputs.picture.extension() == ".csv" && outputs.csv.empty()) outputs = {{}, outputs.picture.string()};
  if (numbers == "-" && outputs.printsData())
    throw Error("--numbers: they and the values of --csv - would be printed together; expected one of them");
  checkOutputs(outputs, inputs);
  const ProbedChart probed = probedChart(arguments, results);
  const std::string asWhole = numbers.empty() ? "" : numbersTable(arguments, results);
  if (!outputs.picture.empty()) writePicture(probed.chart, outputs);
  if (outputs.printsData()) {
    printText(probed.table);
  } else if (!outputs.csv.empty()) {
    writeText(probed.table, outputs.csv);
  }
  if (!numbers.empty()) writeNumbers(asWhole, numbers, inputs);
  return ExitCode::Fine;
}

void addProbeOptions(CLI::App& command, ProbeArguments& arguments) {
  command
      .add_option("RESULT", arguments.results,
                  "Directories of runs, the result files in them, or files of other programs")
      ->required();
  command
      .add_option(
          "--frame", arguments.frame,
          "Number of the frame, last or end, or time=T; for several A-B, all, or a list with commas [last, over time all]")
      ->type_name("N|A-B|all|last|time=T");
  arguments.probe.addTo(command, AnyProbeSpec{});
  command
      .add_option("--section", arguments.section,
                  "Of --numbers: a plane, and what one part of the body does to the other across it")
      ->type_name("x=V|y=V|z=V|X,Y,Z,NX,NY,NZ");
  for (const auto& [option, type] :
       {std::pair{"--line", "X0,Y0:X1,Y1"}, std::pair{"--face", "NAME"}, std::pair{"--depth", "FACE@PLACE"},
        std::pair{"--point", "X,Y"}, std::pair{"--field", "FIELD,..."}, std::pair{"--body", "BODY,..."}})
    command.get_option(option)->type_name(type);
}

}  // namespace

void addProbeCommand(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("probe", "Draw exact values along paths in a body, or at a point over time");
  const auto arguments = std::make_shared<ProbeArguments>();
  const auto outputs = std::make_shared<ChartOutputs>();
  addProbeOptions(*command, *arguments);
  addAxisOptions(*command, arguments->chart, {"distance or time", "the fields"}, {"x", "y", "xy"});
  addDrawingOptions(*command, arguments->chart, "directory, time, field or several of them");
  command->add_option("--csv", outputs->csv, "Write a table of the values to this file too, or print it: -")
      ->type_name("FILE.csv|-");
  command
      ->add_option("-o,--output", outputs->picture,
                   "Name of the chart, or of a table alone; - for a PNG on standard output")
      ->type_name("CHART.png|svg|pdf|csv|-");
  const auto numbers = std::make_shared<std::string>();
  command
      ->add_option(
          "--numbers", *numbers,
          "Of --depth or --section: write what the profile, or the section, says as a whole to this file, or "
          "print it: -")
      ->type_name("FILE.csv|-");
  command->callback([&action, arguments, outputs, numbers] {
    action = [arguments, outputs, numbers] { return probe(*arguments, *outputs, *numbers); };
  });
}

}  // namespace burnish
