#include "postproc/draw/page/picture_look.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "postproc/draw/page/color_name.h"

namespace burnish {

std::optional<ChosenTheme> Spelling<ChosenTheme>::read(const std::string& text) {
  const auto& names = themeNames();
  if (!isThemeFile(text) && std::find(names.begin(), names.end(), text) == names.end()) return std::nullopt;
  return ChosenTheme{themeFrom(text), text};
}

std::string Spelling<ChosenTheme>::words() {
  return fmt::format("{}, or a file that ends in .yaml", fmt::join(themeNames(), ", "));
}

std::optional<FontName> Spelling<FontName>::read(const std::string& text) {
  fontNamed(text);
  return FontName{text};
}

std::optional<Color> Spelling<Color>::read(const std::string& text) {
  return colorNamed(text);
}

std::string Spelling<Color>::write(const Color& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

std::string Spelling<Color>::words() {
  return kColorWords;
}

const std::vector<std::string>& Spelling<Color>::candidates() {
  return colorNames();
}

void resolveLookFiles(YamlNode& picture, const std::filesystem::path& directory) {
  for (YamlNode& value : picture.children) {
    const bool isFile =
        (value.key == "theme" && isThemeFile(value.text)) || (value.key == "font" && isFontFile(value.text));
    if (isFile) value.text = std::filesystem::absolute(directory / value.text).lexically_normal().string();
  }
}

Theme themeOf(const PageLook& look) {
  Theme theme = look.theme;
  if (look.font) theme.font = look.font->name;
  return theme;
}

}  // namespace burnish
