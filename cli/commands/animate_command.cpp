#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/commands/picture_options.h"
#include "cli/commands/picture_source.h"
#include "cli/console.h"
#include "cli/jobs/child_process.h"
#include "engine/core/error.h"
#include "postproc/export/scratch_directory.h"
#include "postproc/export/video.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

struct AnimateArguments {
  PictureArguments options;
  fs::path video;
  double framesPerSecond = 10.0;
};

void checkName(const AnimateArguments& arguments) {
  const std::string ending = arguments.video.extension().string();
  if (ending != ".mp4" && ending != ".png" && ending != ".gif")
    throw Error(fmt::format("-o: found \"{}\"; expected the name of a video that ends in .mp4, .png or .gif",
                            arguments.video.string()));
  if (ending != ".png" && !haveFfmpeg())
    throw Error(
        fmt::format("-o: {} needs the program ffmpeg, which is not in PATH; install it (Debian: apt-get "
                    "install ffmpeg), or take {}, an animated PNG",
                    arguments.video.string(), fs::path(arguments.video).replace_extension(".png").string()));
}

/// Writes what the name's ending says.
void write(const std::vector<fs::path>& frames, double rate, const fs::path& file) {
  if (file.extension() == ".png") return writeAnimatedPng(frames, rate, file);
  if (!(file.extension() == ".gif" ? writeGif(frames, rate, file) : writeVideo(frames, rate, file)))
    throw Error(fmt::format("cannot write {}: the program ffmpeg has vanished from PATH", file.string()));
}

ExitCode animate(const AnimateArguments& arguments) {
  const SignalGuard signals(SecondSignal::Ends);
  checkName(arguments);
  const PictureSource source = pictureSource(arguments.options);
  const std::vector<int> frames = frameIndices(arguments.options.frame, source.times);
  const PictureSource::Series series = source.series(frames);
  if (series.isTransparent && arguments.video.extension() == ".mp4")
    throw Error("--transparent: an MP4 video has no alpha channel; take .png or .gif");
  makeDirectoryOf(arguments.video);
  const ScratchDirectory scratch;
  std::vector<fs::path> pictures;
  for (const int frame : frames) pictures.push_back(scratch.path() / fmt::format("{}.png", frame));
  series.draw(pictures);
  write(pictures, arguments.framesPerSecond, arguments.video);
  printOut("{} frames in {}\n", frames.size(), arguments.video.string());
  return ExitCode::Fine;
}

}  // namespace

void addAnimateCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("animate", "Draw frames into a video");
  const auto arguments = std::make_shared<AnimateArguments>();
  arguments->options.frame = "all";
  addPictureArguments(*command, arguments->options);
  command->add_option("--rate", arguments->framesPerSecond, "Frames per second [10]")
      ->check(CLI::Range(0.1, 100.0))
      ->type_name("FPS");
  command
      ->add_option("-o,--output", arguments->video,
                   "Name of the video: .mp4 or .gif, which need the program ffmpeg, or .png (animated)")
      ->type_name("VIDEO.mp4|png|gif")
      ->required();
  command->callback([&action, arguments] { action = [arguments] { return animate(*arguments); }; });
}

}  // namespace burnish
