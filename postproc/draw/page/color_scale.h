#pragma once
#include <vtkSmartPointer.h>

#include <array>
#include <string>
#include <vector>

class vtkLookupTable;

namespace burnish {

using Color = std::array<unsigned char, 3>;  ///< red, green, blue

/// viridis, cividis, batlow and grey, whose lightness only grows; coolwarm, for values about a middle; turbo
/// and rainbow.
const std::vector<std::string>& colormapNames();

inline constexpr int kMostBands = 256;

/// Colours for the values of a range: the whole colour map, smooth or in equal bands. Values outside have the
/// colours of the ends.
class ColorScale {
 public:
  /// bands: 0 for smooth colours. Throws `Error` for an unknown map, bands outside [0, `kMostBands`] and a
  /// range that is not drawable.
  ColorScale(const std::string& colormap, const std::array<double, 2>& range, int bands);

  const std::array<double, 2>& range() const { return range_; }

  /// The different colours from the lowest to the highest value, each for an equal part of the range.
  const std::vector<Color>& colors() const { return colors_; }

  Color color(double value) const;

  /// The same as a table of VTK.
  vtkSmartPointer<vtkLookupTable> table() const;

 private:
  std::array<double, 2> range_;
  std::vector<Color> colors_;
};

}  // namespace burnish
