#pragma once

namespace burnish::inline nurbs {

/// Of the keys `file` and `entry` of control nets.
inline constexpr const char* kNetFileSentence =
    "File beside the scene that holds degrees, knots, points and weights, instead of giving them here: YAML, g2 of "
    "GoTools, or JSON as geomdl and burnish export write it.";
inline constexpr const char* kNetEntrySentence =
    "Which one of several in a g2 or JSON file, from 0; needed if there are several.";

/// Of those of bodies, which may be faces of CAD files, too.
inline constexpr const char* kBodyNetFileSentence =
    "File beside the scene that holds degrees, knots, points and weights, instead of giving them here: YAML, g2 of "
    "GoTools, JSON as geomdl and burnish export write it, or CAD (STEP, IGES), of which it is a face.";
inline constexpr const char* kNetFaceSentence =
    "Of a CAD file: name of a face that is not trimmed, or its number from 1 in the order of the file; needed if there "
    "are several.";
inline constexpr const char* kNetUnitSentence =
    "Of a CAD file, which says its own unit: that of the scene's lengths; the one of units unless it is said here.";
inline constexpr const char* kNetFlipSentence =
    "Of a CAD file: the two directions of the face change places, for a body on its other side.";

}  // namespace burnish::inline nurbs
