#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "cli/arguments.h"
#include "cli/command.h"
#include "engine/core/error.h"
#include "engine/results/result_reader.h"
#include "postproc/draw/contour.h"

namespace burnish {
namespace {

struct RenderArguments {
  std::filesystem::path result;
  std::filesystem::path picture;
  std::string frame = "last";
  std::string field;
  std::string range;
  std::optional<double> clip;
  std::string size;
  std::string colormap;
  int bands = 0;
  int subdivision = 0;
  bool knots = false;
};

/// What one most probably wants to see: plastic strain where there is any law for it, else the von Mises
/// stress.
std::string defaultField(const FrameRecord& frame) {
  return frame.fields.contains("plastic_strain") ? "plastic_strain" : "von_mises";
}

ExitCode render(const RenderArguments& arguments) {
  if (arguments.picture.extension() != ".png")
    throw Error(fmt::format("-o: found \"{}\"; expected the name of a picture that ends in .png",
                            arguments.picture.string()));
  ContourOptions options;
  if (!arguments.range.empty()) options.range = rangeFromText(arguments.range);
  if (arguments.clip && !arguments.range.empty())
    throw Error("--clip and --range both say where the colours end; give one of them");
  if (arguments.clip && !(*arguments.clip > 50.0 && *arguments.clip <= 100.0))
    throw Error(fmt::format("--clip: found {}; expected a percentile above 50, up to 100", *arguments.clip));
  options.clip = arguments.clip;
  if (!arguments.size.empty()) options.size = sizeFromText(arguments.size);
  if (!arguments.colormap.empty()) options.colormap = arguments.colormap;
  if (arguments.subdivision > 0) options.subdivision = arguments.subdivision;
  options.bands = arguments.bands;
  options.knots = arguments.knots;
  const ResultReader reader(arguments.result);
  const FrameRecord frame = reader.frame(frameIndex(arguments.frame, reader.times()));
  options.field = arguments.field.empty() ? defaultField(frame) : arguments.field;
  makeDirectoryOf(arguments.picture);
  drawContour(reader.model(), frame, options, arguments.picture);
  return ExitCode::Fine;
}

}  // namespace

void addRenderCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("render", "Draw a contour picture of a frame");
  const auto arguments = std::make_shared<RenderArguments>();
  command->add_option("RESULT", arguments->result, "Directory of a run or the result file in it")->required();
  command->add_option("--frame", arguments->frame, "Number of the frame, last, or time=T [last]")
      ->type_name("N|last|time=T");
  command
      ->add_option(
          "--field", arguments->field,
          "displacement, plastic_strain, von_mises, stress.xx, ..., pressure [plastic_strain or von_mises]")
      ->type_name("NAME");
  command->add_option("--range", arguments->range, "Values at the ends of the colour scale [of the frame]")
      ->type_name("LO,HI");
  command
      ->add_option(
          "--clip", arguments->clip,
          "End the colours at this percentile and at 100 minus it, by undeformed area (2D) or volume "
          "(3D), so that a spike leaves colours for the rest; the picture says so [no]")
      ->type_name("P");
  command->add_option("--size", arguments->size, "Size of the picture in pixels [1600,900]")
      ->type_name("W,H");
  command->add_option("--colormap", arguments->colormap, "viridis, rainbow, coolwarm or grey [viridis]")
      ->type_name("NAME");
  command
      ->add_option("--subdivision", arguments->subdivision,
                   "Cells per knot span and direction: more for smoother lines [that of the scene]")
      ->check(CLI::Range(1, 64));
  command->add_option("--bands", arguments->bands, "Number of colour bands, 0 for smooth colours [0]")
      ->check(CLI::Range(0, 256));
  command->add_flag("--knots", arguments->knots, "Draw the knot lines");
  command->add_option("-o,--output", arguments->picture, "Name of the picture")
      ->type_name("PICTURE.png")
      ->required();
  command->callback([&action, arguments] { action = [arguments] { return render(*arguments); }; });
}

}  // namespace burnish
