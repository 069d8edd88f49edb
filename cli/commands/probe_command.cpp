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
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

ExitCode probe(const ProbeArguments& arguments, ChartOutputs outputs) {
  const SignalGuard signals(SecondSignal::Ends);
  std::vector<ResultReader> results;
  std::vector<std::filesystem::path> inputs;
  for (const std::filesystem::path& result : arguments.results)
    inputs.push_back(results.emplace_back(result).file());
  if (outputs.picture.extension() == ".csv" && outputs.csv.empty()) outputs = {{}, outputs.picture.string()};
  checkOutputs(outputs, std::move(inputs));
  const ProbedChart probed = probedChart(arguments, results);
  if (!outputs.picture.empty()) {
    makeDirectoryOf(outputs.picture);
    drawChart(probed.chart, outputs.picture);
  }
  if (outputs.printsData()) {
    printText(probed.table);
  } else if (!outputs.csv.empty()) {
    writeText(probed.table, outputs.csv);
  }
  return ExitCode::Fine;
}

/// The places, of which there is to be one.
void addPlaces(CLI::App& command, ProbeArguments& arguments) {
  const std::vector<CLI::Option*> places{
      command
          .add_option("--line", arguments.line,
                      "Values along the straight line between two points of the body")
          ->type_name("X0,Y0:X1,Y1"),
      command
          .add_option("--point", arguments.point,
                      "Values over time at a point of the material, by its place in the undeformed body")
          ->type_name("X,Y"),
      command.add_option("--face", arguments.face, "Values along a face of a plane body: left, right, ...")
          ->type_name("NAME"),
      command
          .add_option(
              "--depth", arguments.depth,
              "Values along the inward normal of a face: from a length along it in the plane, or from "
              "the point of it that is nearest to a position")
          ->type_name("FACE@S|X,Y")};
  for (CLI::Option* place : places)
    for (CLI::Option* other : places)
      if (place != other) place->excludes(other);
  CLI::Option* point = places[1];
  command.add_option("--length", arguments.length, "How deep --depth goes [to where it leaves the body]")
      ->needs(places.back())
      ->type_name("L");
  command.add_option("--patch", arguments.patch, "Patch of the face, in a body of several")
      ->type_name("NAME");
  command
      .add_flag("--reference", arguments.reference,
                "The path lies in the undeformed body and is measured there, not in the deformed one")
      ->excludes(point);
  command
      .add_option("--points", arguments.points,
                  "Points at equal distances; those where the path leaves a body are added [401]")
      ->check(CLI::Range(2, 1'000'000))
      ->excludes(point)
      ->type_name("N");
  CLI::Option* window =
      command
          .add_option(
              "--window", arguments.window,
              "Mean values of a window of this width along the path instead of values at points [none]")
          ->excludes(point)
          ->type_name("W");
  command
      .add_flag("--mean", arguments.mean, "The mean of all of the path over time instead of values along it")
      ->excludes(point)
      ->excludes(window);
}

void addWhat(CLI::App& command, ProbeArguments& arguments) {
  command.add_option("RESULT", arguments.results, "Directories of runs or the result files in them")
      ->required();
  command
      .add_option("--field", arguments.fields,
                  "displacement, plastic_strain, von_mises, stress.xx, ...; once or several times "
                  "[plastic_strain or von_mises]")
      ->expected(1)
      ->take_all()
      ->type_name("NAME");
  command
      .add_option("--frame", arguments.frame,
                  "Number of the frame, last or end, or time=T; for several A-B or all [last, over time all]")
      ->type_name("N|A-B|all|last|time=T");
  command.add_option("--body", arguments.bodies, "Some of several bodies alone [all]")
      ->delimiter(',')
      ->expected(1)
      ->take_all()
      ->type_name("NAME");
}

}  // namespace

void addProbeCommand(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("probe", "Draw exact values along paths in a body, or at a point over time");
  const auto arguments = std::make_shared<ProbeArguments>();
  const auto outputs = std::make_shared<ChartOutputs>();
  addWhat(*command, *arguments);
  addPlaces(*command, *arguments);
  addAxisOptions(*command, arguments->chart, {"distance or time", "the fields"}, {"x", "y", "xy"});
  addDrawingOptions(*command, arguments->chart, "directory, time, field or several of them");
  command->add_option("--csv", outputs->csv, "Write a table of the values to this file too, or print it: -")
      ->type_name("FILE.csv|-");
  command->add_option("-o,--output", outputs->picture, "Name of the chart, or of a table alone")
      ->type_name("CHART.png|svg|pdf|csv");
  command->callback([&action, arguments, outputs] {
    action = [arguments, outputs] { return probe(*arguments, *outputs); };
  });
}

}  // namespace burnish
