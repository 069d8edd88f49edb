#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/commands/picture_options.h"
#include "cli/console.h"
#include "cli/jobs/child_process.h"
#include "engine/core/error.h"
#include "postproc/draw/contour/frame_pictures.h"
#include "postproc/foreign/foreign_source.h"
#include "postproc/view/view.h"

namespace burnish {
namespace {

struct ViewArguments {
  std::filesystem::path result, page;
  std::string frame = "all";
  std::optional<int> frames;
  std::vector<std::string> fields;
  DeclaredOptions options;
};

/// The frames that were asked for, thinned to at most so many.
std::vector<int> viewedFrames(const ViewArguments& arguments, const std::vector<double>& times) {
  const std::vector<int> all = frameIndices(arguments.frame, times);
  if (!arguments.frames) return all;
  std::vector<int> some;
  for (const int k : evenlyChosen(static_cast<int>(all.size()), *arguments.frames))
    some.push_back(all[static_cast<std::size_t>(k)]);
  return some;
}

ExitCode view(const ViewArguments& arguments) {
  const SignalGuard signals(SecondSignal::Ends);
  if (arguments.page.extension() != ".html")
    throw Error(fmt::format("-o: found \"{}\"; expected the name of a page that ends in .html",
                            arguments.page.string()));
  std::error_code status;
  if (!std::filesystem::is_directory(arguments.result, status) && !foreignKind(arguments.result).empty())
    throw Error(fmt::format(
        "{}: a page shows results of burnish; burnish render and burnish animate draw files of other programs",
        arguments.result.string()));
  const ResultReader result(arguments.result);
  ViewOptions options;
  readPicture(arguments.options, options, result.model().dim);
  if (options.range && arguments.fields.size() != 1)
    throw Error("--range: it goes with one field, which --field names");
  const std::vector<int> frames = viewedFrames(arguments, result.times());
  makeDirectoryOf(arguments.page);
  const std::size_t size = writeView(result, frames, arguments.fields, options, arguments.page);
  printOut("{} frames in {}, {:.2f} MB\n", frames.size(), arguments.page.string(),
           static_cast<double>(size) / 1e6);
  return ExitCode::Fine;
}

}  // namespace

void addViewCommand(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("view", "Write a page on which a body can be turned, zoomed, cut and played");
  const auto arguments = std::make_shared<ViewArguments>();
  command->add_option("RESULT", arguments->result, "Directory of a run or the result file in it")->required();
  command
      ->add_option(
          "--frame", arguments->frame,
          "Frames of the page: all, A-B, one by its number, last, or time=T, or a list with commas [all]")
      ->type_name("N|A-B|all|last|time=T");
  command->add_option("--frames", arguments->frames, "Of these at most so many; evenly chosen")
      ->check(CLI::Range(2, 100000));
  command
      ->add_option("--field", arguments->fields,
                   "Fields of the page, the first one shown at first, as for render "
                   "[plastic_strain, von_mises and displacement, those that there are]")
      ->delimiter(',')
      ->type_name("FIELD,...");
  addPictureOptions(*command, arguments->options, ViewOptions{});
  command->add_option("-o,--output", arguments->page, "Name of the page")->type_name("PAGE.html")->required();
  command->callback([&action, arguments] { action = [arguments] { return view(*arguments); }; });
}

}  // namespace burnish
