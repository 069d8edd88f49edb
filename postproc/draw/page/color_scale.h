#pragma once
#include <vtkSmartPointer.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

class vtkLookupTable;

namespace burnish {

using Color = std::array<unsigned char, 3>;  ///< red, green, blue

/// How well one colour is told from another by their light alone: from 1, not at all, to 21, black from white (the
/// contrast ratio of WCAG).
double contrastOf(const Color& a, const Color& b);

/// viridis, cividis, batlow and grey, whose lightness only grows; coolwarm, for values about a middle; turbo
/// and rainbow.
const std::vector<std::string>& colormapNames();

/// Instead of a name: viridis, or coolwarm about zero for a field whose sign means something.
inline constexpr const char* kAutomaticColormap = "auto";

/// What a picture may ask for: `kAutomaticColormap` and the names.
const std::vector<std::string>& colormapChoices();

/// Whether the map has a middle that stands out, for values to either side of one.
bool isDiverging(const std::string& colormap);

inline constexpr int kMostBands = 256;

/// Colours for the values of a range, smooth or in equal bands: the whole colour map, or as much of it as the
/// range takes about the value in its middle. Values outside have the colours of the ends.
class ColorScale {
 public:
  /// bands: 0 for smooth colours. middle: the value within the range that has the colour in the middle of the
  /// map, whose ends stand for values as far to either side as the farther end of the range; when left out
  /// the ends of the map are those of the range. Throws `Error` for an unknown map, bands outside
  /// [0, `kMostBands`] and a range that is not drawable.
  ColorScale(const std::string& colormap, const std::array<double, 2>& range, int bands,
             std::optional<double> middle = {});

  const std::array<double, 2>& range() const { return range_; }

  /// The different colours from the lowest to the highest value, each for an equal part of the range.
  const std::vector<Color>& colors() const { return colors_; }

  /// Colours at equal distances over the range that give the scale when they are joined straight in RGB; of
  /// bands, theirs.
  const std::vector<Color>& joints() const { return joints_; }

  Color color(double value) const;

  /// The same as a table of VTK.
  vtkSmartPointer<vtkLookupTable> table() const;

 private:
  std::array<double, 2> range_;
  std::vector<Color> colors_, joints_;
};

}  // namespace burnish
