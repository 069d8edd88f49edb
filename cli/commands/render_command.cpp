#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/commands/picture_options.h"
#include "cli/commands/picture_source.h"
#include "cli/console.h"
#include "cli/jobs/child_process.h"
#include "cli/late_vtk.h"
#include "cli/output_target.h"
#include "engine/core/error.h"
#include "postproc/draw/page/print_file.h"

namespace burnish {
namespace {

struct RenderArguments {
  PictureArguments options;
  std::string picture;
};

/// Throws `Error` for other endings than those of pictures, and for options that are those of the others.
void checkOutput(const RenderArguments& arguments) {
  if (isPrintFile(arguments.picture)) return;
  if (!isStandardOutput(arguments.picture) && std::filesystem::path(arguments.picture).extension() != ".png")
    throw Error(
        fmt::format("-o: found \"{}\"; expected the name of a picture that ends in .png, .pdf or .svg, or -",
                    arguments.picture));
  requireNoPrintOptions(arguments.options.picture);
}

ExitCode render(RenderArguments& arguments) {
  const SignalGuard signals(SecondSignal::Ends);
  checkOutput(arguments);
  arguments.options.isForPrint = isPrintFile(arguments.picture);
  const PictureSource source = pictureSource(arguments.options);
  const std::vector<int> frames = frameIndices(arguments.options.frame, source.times);
  std::vector<std::filesystem::path> names = pictureNames(arguments.picture, frames, source.times);
  loadVtk();
  const OutputTarget target(names.front(), ".png");
  if (names.size() == 1) names.front() = target.file();
  const PictureSource::Series series = source.series(frames);
  for (const std::filesystem::path& name : names) makeDirectoryOf(name);
  series.draw(names);
  target.finish();
  if (names.size() > 1)
    printOut("{} pictures, {} to {}\n", names.size(), names.front().string(), names.back().string());
  return ExitCode::Fine;
}

}  // namespace

void addRenderCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("render", "Draw contour pictures of frames");
  const auto arguments = std::make_shared<RenderArguments>();
  addPictureArguments(*command, arguments->options);
  arguments->options.picture.addTo(*command, PrintOptions{});
  command
      ->add_option(
          "-o,--output", arguments->picture,
          "Name of the picture, .png, or .pdf or .svg for print, where sizes are in points and the usual "
          "one is 482,271; - for a PNG on standard output; for several frames with {frame} or {frame:04} or {time} in it")
      ->type_name("PICTURE.png|pdf|svg|-")
      ->required();
  command->callback([&action, arguments] { action = [arguments] { return render(*arguments); }; });
}

}  // namespace burnish
