#include "postproc/draw/page/theme.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "engine/schema/mapping_reader.h"
#include "engine/schema/yaml_document.h"
#include "postproc/draw/page/theme_files.h"
#include "postproc/draw/page/theme_schema.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

const DocumentKind kThemeKind{.name = "theme", .keys = "base, paper, ink and font"};

using Themes = std::map<std::string, Theme>;

void setColors(const ThemeSpec& spec, const YamlNode& root, Theme& theme, Diagnostics& errors) {
  for (std::size_t k = 0; k < kThemeColors.size(); ++k) {
    const auto& [key, color, sentence] = kThemeColors[k];
    const YamlNode* node = root.find(key);
    if (node == nullptr) continue;
    if (node->kind == YamlNode::Kind::Null)
      errors.add(node->keyPlace, key,
                 "found nothing; a colour such as \"#1e1e1e\" stands in quotes, as # begins a comment.");
    if (spec.colors[k]) theme.*color = *spec.colors[k];
  }
}

void setFont(const ThemeSpec& spec, const YamlNode& root, const fs::path& directory, Theme& theme,
             Diagnostics& errors) {
  if (!spec.font) return;
  theme.font = isFontFile(*spec.font) ? (directory / *spec.font).string() : *spec.font;
  try {
    fontNamed(theme.font);
  } catch (const Error& error) {
    errors.add(placeOf(root, "font"), "", error.what());
  }
}

/// `themes`: what may be a base.
Theme parseTheme(const std::string& yaml, const fs::path& file, const Themes& themes) {
  Diagnostics errors(file.string(), {});
  const YamlNode root = parseDocument(yaml, kThemeKind, errors);
  ThemeSpec spec;
  const YamlNode* base = root.find("base");
  const auto found = themes.find(base != nullptr ? base->text : spec.base);
  Theme theme = found != themes.end() ? found->second : Theme{};
  spec.textSize = theme.textSize;
  spec.picture = theme.picture;
  std::vector<DimensionedList> dimensioned;  // a theme has none
  MappingReader(root, "", errors, dimensioned).readInto(spec);
  theme.textSize = spec.textSize;
  theme.picture = spec.picture;
  setColors(spec, root, theme, errors);
  setFont(spec, root, file.parent_path(), theme, errors);
  errors.throwIfAny();
  return theme;
}

const Themes& builtInThemes() {
  static const Themes table = [] {
    Themes themes;
    for (const auto& [name, yaml] : kThemeFiles)
      themes[name] = parseTheme(yaml, std::string(name) + ".yaml", themes);
    return themes;
  }();
  return table;
}

}  // namespace

const std::vector<std::string>& themeNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& [name, yaml] : kThemeFiles) list.emplace_back(name);
    return list;
  }();
  return names;
}

const Theme& themeNamed(const std::string& name) {
  const auto theme = builtInThemes().find(name);
  if (theme != builtInThemes().end()) return theme->second;
  throw Error(fmt::format("theme: found \"{}\"; allowed: {}, or a file that ends in .yaml.{}", name,
                          fmt::join(themeNames(), ", "), didYouMean(name, themeNames())));
}

Theme readTheme(const fs::path& file) {
  return parseTheme(readDocument(file, kThemeKind), file, builtInThemes());
}

bool isThemeFile(const std::string& nameOrFile) {
  const fs::path ending = fs::path(nameOrFile).extension();
  return ending == ".yaml" || ending == ".yml" || nameOrFile.find('/') != std::string::npos;
}

Theme themeFrom(const std::string& nameOrFile) {
  return isThemeFile(nameOrFile) ? readTheme(nameOrFile) : themeNamed(nameOrFile);
}

}  // namespace burnish
