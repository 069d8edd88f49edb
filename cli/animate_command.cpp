#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/picture_options.h"
#include "engine/core/error.h"
#include "postproc/draw/contour_series.h"
#include "postproc/export/scratch_directory.h"
#include "postproc/export/video.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

struct AnimateArguments {
  PictureOptions options;
  fs::path video;
  double framesPerSecond = 10.0;
};

/// Writes what the name's ending says and returns the file that was written: without ffmpeg an animated PNG
/// instead of an MP4.
fs::path write(const std::vector<fs::path>& frames, double rate, const fs::path& file) {
  const fs::path animatedPng = fs::path(file).replace_extension(".png");
  if (file.extension() == ".mp4" && writeVideo(frames, rate, file)) return file;
  if (file.extension() == ".gif") {
    if (writeGif(frames, rate, file)) return file;
    throw Error(fmt::format("{}: GIF needs the program ffmpeg, which is not in PATH; take {} instead",
                            file.string(), animatedPng.string()));
  }
  writeAnimatedPng(frames, rate, animatedPng);
  return animatedPng;
}

void checkName(const AnimateArguments& arguments) {
  const std::string ending = arguments.video.extension().string();
  if (ending != ".mp4" && ending != ".png" && ending != ".gif")
    throw Error(fmt::format("-o: found \"{}\"; expected the name of a video that ends in .mp4, .png or .gif",
                            arguments.video.string()));
  if (ending == ".mp4" && arguments.options.transparent)
    throw Error("--transparent: an MP4 video has no alpha channel; take .png or .gif");
}

ExitCode animate(const AnimateArguments& arguments) {
  checkName(arguments);
  const ResultReader result(arguments.options.result);
  const std::vector<int> frames = frameIndices(arguments.options.frame, result.times());
  const ContourOptions options = contourOptions(arguments.options, result, frames);
  makeDirectoryOf(arguments.video);
  const ScratchDirectory scratch;
  std::vector<fs::path> pictures;
  for (const int frame : frames) pictures.push_back(scratch.path() / fmt::format("{}.png", frame));
  drawSeries(result, frames, options, pictures);
  const fs::path written = write(pictures, arguments.framesPerSecond, arguments.video);
  if (written != arguments.video)
    fmt::print("ffmpeg is not in PATH: an animated PNG was written instead of a video\n");
  fmt::print("{} frames in {}\n", frames.size(), written.string());
  return ExitCode::Fine;
}

}  // namespace

void addAnimateCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("animate", "Draw frames into a video");
  const auto arguments = std::make_shared<AnimateArguments>();
  arguments->options.frame = "all";
  addPictureOptions(*command, arguments->options);
  command->add_option("--rate", arguments->framesPerSecond, "Frames per second [10]")
      ->check(CLI::Range(0.1, 100.0))
      ->type_name("FPS");
  command
      ->add_option("-o,--output", arguments->video,
                   "Name of the video: .mp4 (an animated PNG where ffmpeg is missing), .png (animated), .gif")
      ->type_name("VIDEO.mp4|png|gif")
      ->required();
  command->callback([&action, arguments] { action = [arguments] { return animate(*arguments); }; });
}

}  // namespace burnish
