#pragma once

namespace burnish {

/// Of the keys `file` and `entry` of control nets.
inline constexpr const char* kNetFileSentence =
    "File beside the scene that holds degrees, knots, points and weights, instead of giving them here: YAML, g2 of "
    "GoTools, or JSON as geomdl and burnish export write it.";
inline constexpr const char* kNetEntrySentence =
    "Which one of several in a g2 or JSON file, from 0; needed if there are several.";

}  // namespace burnish
