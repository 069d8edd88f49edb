#include "postproc/draw/page/sheet.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/declared_options.h"
#include "cli/output_target.h"
#include "engine/core/error.h"
#include "postproc/draw/page/picture_look.h"

namespace burnish {
namespace {

struct SheetArguments {
  std::vector<std::filesystem::path> pictures;
  std::filesystem::path sheet;
  int columns = 0;  ///< 0: as many as rows
  std::vector<std::string> captions;
  int width = 1600;
  DeclaredOptions look;  ///< of a `PageLook`
};

ExitCode sheet(const SheetArguments& arguments) {
  const std::size_t count = arguments.pictures.size();
  if (arguments.sheet.extension() != ".png" && !isStandardOutput(arguments.sheet))
    throw Error(fmt::format("-o: found \"{}\"; expected the name of a picture that ends in .png, or -",
                            arguments.sheet.string()));
  if (!arguments.captions.empty() && arguments.captions.size() != count)
    throw Error(fmt::format("--caption: found {} captions for {} pictures; expected one for each",
                            arguments.captions.size(), count));
  requireNotInput("-o", arguments.sheet, arguments.pictures);
  std::vector<SheetPanel> panels;
  for (std::size_t k = 0; k < count; ++k)
    panels.push_back({arguments.pictures[k], arguments.captions.empty() ? "" : arguments.captions[k]});
  const int columns = arguments.columns > 0
                          ? arguments.columns
                          : static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
  PageLook look;
  arguments.look.readInto(look);
  const OutputTarget target(arguments.sheet, ".png");
  makeDirectoryOf(target.file());
  drawSheet(panels, columns, arguments.width, target.file(), themeOf(look));
  target.finish();
  return ExitCode::Fine;
}

}  // namespace

void addSheetCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("sheet", "Lay pictures out in a grid with captions");
  const auto arguments = std::make_shared<SheetArguments>();
  command->add_option("PICTURE", arguments->pictures, "PNG pictures, row by row")->required();
  command->add_option("--columns", arguments->columns, "Pictures side by side [as many as rows]")
      ->check(CLI::Range(1, 100));
  command
      ->add_option("--caption", arguments->captions,
                   "What stands under a picture, once per picture [nothing]")
      ->expected(1)
      ->take_all()
      ->check(cannotBeShown)
      ->type_name("TEXT");
  command->add_option("--width", arguments->width, "Width of the sheet in pixels [1600]")->type_name("W");
  arguments->look.addTo(*command, PageLook{});
  command->add_option("-o,--output", arguments->sheet, "Name of the sheet; - for standard output")
      ->type_name("SHEET.png|-")
      ->required();
  command->callback([&action, arguments] { action = [arguments] { return sheet(*arguments); }; });
}

}  // namespace burnish
