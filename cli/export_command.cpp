#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "cli/command.h"
#include "engine/core/error.h"
#include "engine/results/result_reader.h"
#include "postproc/export/vtu_series_writer.h"

namespace burnish {
namespace {

struct ExportArguments {
  std::filesystem::path result;
  std::filesystem::path directory;
};

ExitCode exportResult(const ExportArguments& arguments) {
  const ResultReader reader(arguments.result);
  const auto directory = arguments.directory.empty() ? reader.file().parent_path() : arguments.directory;
  if (reader.numFrames() == 0)
    throw Error(
        fmt::format("{}: the result has no frames to export; is the folder 'result' beside it missing?",
                    reader.file().string()));
  VtuSeriesWriter writer(directory, reader.model());
  for (int i = 0; i < reader.numFrames(); ++i) writer.write(reader.frame(i));
  fmt::print("{} frames in {}\n", reader.numFrames(), (directory / "frames.pvd").string());
  return ExitCode::Fine;
}

}  // namespace

void addExportCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("export", "Write VTU files and a PVD collection from the results");
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("RESULT", arguments->result, "Directory of a run or the result file in it")->required();
  command->add_option("-o,--output", arguments->directory,
                      "Directory for frames.pvd and frames/ [that of the result]");
  command->callback([&action, arguments] { action = [arguments] { return exportResult(*arguments); }; });
}

}  // namespace burnish
