#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "postproc/draw/page/color_scale.h"
#include "postproc/draw/page/font.h"

namespace burnish {

/// What a contour picture shows unless it is asked for something else: the part of `PictureOptions` that a
/// theme states.
struct PictureDefaults {
  std::string colormap = kAutomaticColormap;
  int bands = 0;
  int isolines = 0;
  bool knots = false;
  bool undeformed = true;
  bool tools = true;
  bool occlusion = true;
  bool doubtMarks = true;

  bool operator==(const PictureDefaults&) const = default;
};

/// The look of a picture apart from the colours of its field. The defaults are the theme `paper`.
struct Theme {
  Color paper{255, 255, 255};
  Color ink{30, 30, 30};      ///< texts, the frame of the colour scale
  Color softInk{95, 95, 95};  ///< texts that stand back
  Color outline{25, 25, 25};  ///< edges of body and tools, isolines
  Color undeformed{150, 150, 150};
  Color knots{255, 255, 255};
  Color tool{222, 222, 222};
  Color controlNet{200, 40, 40};
  std::string font = kDefaultFont;  ///< see `fontNamed`
  double textSize = 1.0;            ///< factor on the size that follows from the picture's
  PictureDefaults picture{};

  bool operator==(const Theme&) const = default;
};

/// paper, dark, slide, complas: the files in postproc/draw/page/themes.
const std::vector<std::string>& themeNames();

/// Throws `Error` that lists the themes and tells the nearest.
const Theme& themeNamed(const std::string& name);

/// Reads a theme: a YAML file with what differs from its `base`. Throws one `Error` with a line for
/// everything that is wrong: `FILE:LINE:COLUMN: key: what was found; what is allowed`.
Theme readTheme(const std::filesystem::path& file);

/// Whether a text stands for a file: it ends in .yaml or .yml or has a slash.
bool isThemeFile(const std::string& nameOrFile);

/// The theme of a name or of a file.
Theme themeFrom(const std::string& nameOrFile);

}  // namespace burnish
