#pragma once
#include <array>
#include <optional>
#include <string>

#include "postproc/draw/page/picture_look.h"

/// The one declaration of every key of a theme, in the manner of engine/scene/schema.h.
namespace burnish {

struct ThemeColor {
  const char* key;
  Color Theme::*color;
  const char* sentence;
};

inline constexpr std::array kThemeColors{
    ThemeColor{"paper", &Theme::paper, "Ground of the picture."},
    ThemeColor{"ink", &Theme::ink, "Texts and the frame of the colour scale."},
    ThemeColor{"soft_ink", &Theme::softInk, "Texts that stand back."},
    ThemeColor{"outline", &Theme::outline, "Edges of body and tools, isolines."},
    ThemeColor{"undeformed", &Theme::undeformed, "Outline of the undeformed body."},
    ThemeColor{"knots", &Theme::knots, "Knot lines."},
    ThemeColor{"tool", &Theme::tool, "Tools."},
    ThemeColor{"control_net", &Theme::controlNet, "Control points and the lines between them."}};

/// A theme file as it is written: what it does not state is that of the base.
struct ThemeSpec {
  std::string base = "paper";
  std::array<std::optional<Color>, kThemeColors.size()> colors;
  std::optional<std::string> font;
  double textSize = 1.0;
  PictureDefaults picture;
};

template <class Visitor>
void describe(Visitor& v, ThemeSpec& s) {
  v.field("base", s.base, {.choices = themeNames()}, "Theme that has what this one does not state.");
  for (std::size_t k = 0; k < kThemeColors.size(); ++k)
    v.field(kThemeColors[k].key, s.colors[k], {}, kThemeColors[k].sentence);
  v.field("font", s.font, {}, "Installed family, or a font file, relative to the theme's.");
  v.field("text_size", s.textSize, {.atLeast = 0.25, .atMost = 4},
          "Factor on the height of the texts, which follows from the picture's size.");
  v.field("picture", s.picture, {}, "What a picture shows unless it is asked for something else.");
}

}  // namespace burnish
