#include "postproc/draw/contour/field_colors.h"

#include <algorithm>
#include <optional>
#include <string>

#include "postproc/draw/contour/color_range.h"

namespace burnish {
namespace {

/// The part of the range that values on either side of zero take at least where colours tell their sign.
constexpr double kEitherSign = 0.05;

}  // namespace

ColorScale colorScaleOf(const FieldChoice& field, const PictureOptions& options,
                        const std::array<double, 2>& shown) {
  const int bands = field.states.empty() ? options.bands : static_cast<int>(field.states.size());
  std::array<double, 2> range = options.range ? shown : widened(shown);
  // Before anything is loaded colours are those of later on.
  if (field.isAboutZero && !options.range && shown[0] == 0.0 && shown[1] == 0.0) range[0] = -range[1];
  const double least = kEitherSign * (range[1] - range[0]);
  const bool bothSigns = field.isAboutZero && std::min(-range[0], range[1]) > least;
  std::string colormap = options.colormap;
  if (colormap == kAutomaticColormap) colormap = bothSigns ? "coolwarm" : "viridis";
  return {colormap, range, bands, bothSigns && isDiverging(colormap) ? std::optional(0.0) : std::nullopt};
}

}  // namespace burnish
