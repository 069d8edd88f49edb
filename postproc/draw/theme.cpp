#include "postproc/draw/theme.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "engine/core/error.h"
#include "engine/scene/nearest.h"

namespace burnish {
namespace {

Theme dark() {
  Theme theme;
  theme.paper = {24, 26, 31};
  theme.ink = {232, 232, 232};
  theme.softInk = {165, 168, 174};
  theme.outline = {225, 225, 225};
  theme.undeformed = {125, 128, 134};
  theme.knots = {255, 255, 255};
  theme.tool = {66, 70, 78};
  theme.controlNet = {255, 120, 110};
  return theme;
}

/// To be read from the last row.
Theme slide() {
  Theme theme;
  theme.ink = {0, 0, 0};
  theme.softInk = {60, 60, 60};
  theme.outline = {0, 0, 0};
  theme.textSize = 1.5;
  return theme;
}

const std::map<std::string, Theme>& themes() {
  static const std::map<std::string, Theme> table{{"paper", {}}, {"dark", dark()}, {"slide", slide()}};
  return table;
}

}  // namespace

const std::vector<std::string>& themeNames() {
  static const std::vector<std::string> names{"paper", "dark", "slide"};
  return names;
}

const Theme& themeNamed(const std::string& name) {
  const auto theme = themes().find(name);
  if (theme != themes().end()) return theme->second;
  throw Error(fmt::format("theme: found \"{}\"; allowed: {}.{}", name, fmt::join(themeNames(), ", "),
                          didYouMean(name, themeNames())));
}

}  // namespace burnish
