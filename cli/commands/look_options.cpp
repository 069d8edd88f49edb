#include "cli/commands/look_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

namespace burnish {

void addLookOptions(CLI::App& command, LookOptions& options) {
  command
      .add_option("--theme", options.theme,
                  fmt::format("{}, or a file with one of your own [paper]", fmt::join(themeNames(), ", ")))
      ->type_name("NAME|FILE.yaml");
  command
      .add_option("--font", options.font,
                  "Font of the texts: a family that is installed, or a file [that of the theme]")
      ->type_name("NAME|FILE.ttf");
}

Theme themeOf(const LookOptions& options) {
  Theme theme = themeFrom(options.theme);
  if (options.font.empty()) return theme;
  fontNamed(options.font);
  theme.font = options.font;
  return theme;
}

}  // namespace burnish
