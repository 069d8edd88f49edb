#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace burnish {

/// A contour picture of a scene.
struct PictureSpec {
  std::string field;
  std::optional<std::string> name;  ///< file name stem; the field's name when left out
  std::vector<double> times;        ///< one picture for each; the last frame when empty
  std::optional<std::array<double, 2>> range;
  std::array<int, 2> size{1600, 900};
  int bands = 0;           ///< number of colour bands; 0: smooth
  bool knots = false;      ///< draw knot lines
  bool undeformed = true;  ///< draw the outline of the undeformed body
  /// See `cutPlaneNamed` and `mirrorPlanesNamed`.
  std::optional<std::string> cut, slice, mirror;
  double toolOpacity = 0.3;
  bool doubtMarks = true;  ///< mark the picture if the run doubts its results
};

}  // namespace burnish
