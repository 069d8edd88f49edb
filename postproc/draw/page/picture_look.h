#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "engine/schema/leaf.h"
#include "engine/schema/yaml_tree.h"
#include "postproc/draw/page/theme.h"

/// The look of any picture as its doors spell it: scenes, studies, themes and options of the command.
namespace burnish {

/// A built-in theme or a file, with the name by which it was asked for.
struct ChosenTheme : Theme {
  std::string name = "paper";
};

/// An installed family or a file; see `fontNamed`.
struct FontName {
  std::string name;
};

template <>
struct Spelling<ChosenTheme> {
  static std::optional<ChosenTheme> read(const std::string& text);
  static std::string write(const ChosenTheme& theme) { return theme.name; }
  static std::string words();
  static const std::vector<std::string>& candidates() { return themeNames(); }
};

template <>
struct Spelling<FontName> {
  static std::optional<FontName> read(const std::string& text);
  static std::string write(const FontName& font) { return font.name; }
  static std::string words() { return "a family that is installed, or a file"; }
  static std::vector<std::string> candidates() { return {}; }
};

template <>
struct Spelling<Color> {
  static std::optional<Color> read(const std::string& text);
  static std::string write(const Color& color);
  static std::string words();
  static const std::vector<std::string>& candidates();
};

/// What holds for every picture: contours, charts and sheets.
struct PageLook {
  ChosenTheme theme;
  std::optional<FontName> font;  ///< instead of the theme's
};

/// Makes the files of theme and font in the mapping of a picture, which are relative to `directory`,
/// absolute.
void resolveLookFiles(YamlNode& picture, const std::filesystem::path& directory);

/// The theme with what is given instead of its own.
Theme themeOf(const PageLook& look);

template <class Visitor>
void describe(Visitor& v, PageLook& s) {
  v.field("theme", s.theme, {},
          "Look of the picture: paper, dark, slide, complas, or a YAML file with one of your own.");
  v.field("font", s.font, {},
          "Font of the texts: a family that is installed, or a file; that of the theme when left out.");
}

template <class Visitor>
void describe(Visitor& v, PictureDefaults& s) {
  v.field("colormap", s.colormap, {.choices = colormapChoices()},
          "Colours; auto is viridis, and coolwarm about zero for stress components and pressures of both "
          "signs.");
  v.field("bands", s.bands, {.atLeast = 0, .atMost = kMostBands},
          "Number of colour bands; 0 for smooth colours.");
  v.field("isolines", s.isolines, {.atLeast = 0, .atMost = 100}, "Number of lines of equal value.");
  v.field("knots", s.knots, {}, "Draw the knot lines.");
  v.field("undeformed", s.undeformed, {}, "Draw the outline of the undeformed body.");
  v.field("tools", s.tools, {}, "Draw the tools.");
  v.field("occlusion", s.occlusion, {},
          "In space, darken what lies close to something else, and the ground below; colours stay readable.");
  v.field("doubt_marks", s.doubtMarks, {}, "Mark the picture if the run doubts its results.");
}

}  // namespace burnish
