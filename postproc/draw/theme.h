#pragma once
#include <string>
#include <vector>

#include "postproc/draw/color_scale.h"

namespace burnish {

/// The look of a contour picture apart from the colours of its field. The defaults are the theme `paper`.
struct Theme {
  Color paper{255, 255, 255};
  Color ink{30, 30, 30};      ///< texts, the frame of the colour scale
  Color softInk{95, 95, 95};  ///< texts that stand back
  Color outline{25, 25, 25};  ///< edges of body and tools, isolines
  Color undeformed{150, 150, 150};
  Color knots{255, 255, 255};
  Color tool{222, 222, 222};
  Color controlNet{200, 40, 40};
  double textSize = 1.0;  ///< factor on the size that follows from the picture's
};

/// paper, dark, slide.
const std::vector<std::string>& themeNames();

/// Throws `Error` that lists the themes and tells the nearest.
const Theme& themeNamed(const std::string& name);

}  // namespace burnish
