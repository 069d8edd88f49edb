#pragma once
#include <optional>
#include <string>
#include <vector>

#include "postproc/draw/page/color_scale.h"

namespace burnish {

/// What `colorNamed` takes, for messages.
inline constexpr const char* kColorWords = "#rrggbb, or a basic name of CSS such as white, black or grey";

/// `#rrggbb` or one of the basic names of CSS and orange; nothing for any other text.
std::optional<Color> colorNamed(const std::string& text);

const std::vector<std::string>& colorNames();

}  // namespace burnish
