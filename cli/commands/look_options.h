#pragma once
#include <string>

#include "postproc/draw/page/theme.h"

namespace CLI {
class App;
}

namespace burnish {

/// What the options on the looks of any picture were given.
struct LookOptions {
  std::string theme = "paper", font;
};

/// Adds --theme and --font to a command.
void addLookOptions(CLI::App& command, LookOptions& options);

/// Throws `Error` for an unknown theme or font.
Theme themeOf(const LookOptions& options);

}  // namespace burnish
