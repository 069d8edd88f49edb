#include "postproc/draw/page/color_scale.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkColorTransferFunction.h>
#include <vtkLookupTable.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/core/drawable_range.h"
#include "engine/core/error.h"
#include "engine/core/nearest.h"

namespace burnish {
namespace {

constexpr int kSmoothColors = kMostBands;

/// So many, joined straight, are within 2 of 255 of a map that is bent.
constexpr int kJointsOfBent = 65;

/// Colours at equal distances, and the space in which they are joined.
struct Colormap {
  enum class Space { Rgb, Diverging } space;
  std::vector<Color> knots;
};

const std::map<std::string, Colormap>& colormaps() {
  using Space = Colormap::Space;
  static const std::map<std::string, Colormap> table{
      {"viridis",
       {Space::Rgb,
        {{68, 1, 84},
         {72, 24, 106},
         {71, 45, 123},
         {66, 64, 134},
         {59, 82, 139},
         {51, 99, 141},
         {44, 114, 142},
         {38, 130, 142},
         {33, 145, 140},
         {31, 160, 136},
         {40, 174, 128},
         {63, 188, 115},
         {94, 201, 98},
         {132, 212, 75},
         {173, 220, 48},
         {216, 226, 25},
         {253, 231, 37}}}},
      {"cividis",
       {Space::Rgb,
        {{0, 34, 78},
         {18, 53, 112},
         {59, 73, 108},
         {87, 93, 109},
         {112, 113, 115},
         {138, 134, 120},
         {165, 156, 116},
         {195, 179, 105},
         {225, 204, 85},
         {254, 232, 56}}}},
      {"turbo",
       {Space::Rgb,
        {{48, 18, 59},
         {73, 62, 174},
         {69, 105, 238},
         {50, 149, 247},
         {38, 188, 225},
         {41, 220, 188},
         {63, 243, 147},
         {101, 253, 110},
         {149, 251, 81},
         {197, 236, 60},
         {236, 209, 46},
         {255, 173, 36},
         {255, 130, 29},
         {240, 86, 22},
         {203, 47, 13},
         {163, 19, 2},
         {122, 4, 3}}}},
      {"batlow",
       {Space::Rgb,
        {{1, 25, 89},
         {16, 63, 96},
         {28, 90, 98},
         {60, 109, 86},
         {104, 123, 62},
         {157, 137, 43},
         {210, 147, 67},
         {248, 161, 123},
         {253, 183, 188},
         {250, 204, 250}}}},
      {"rainbow", {Space::Rgb, {{0, 0, 255}, {0, 255, 255}, {0, 255, 0}, {255, 255, 0}, {255, 0, 0}}}},
      {"coolwarm", {Space::Diverging, {{59, 76, 192}, {180, 4, 38}}}},
      {"grey", {Space::Rgb, {{40, 40, 40}, {240, 240, 240}}}}};
  return table;
}

vtkSmartPointer<vtkColorTransferFunction> transferFunction(const Colormap& map) {
  const auto function = vtkSmartPointer<vtkColorTransferFunction>::New();
  if (map.space == Colormap::Space::Diverging) function->SetColorSpaceToDiverging();
  for (std::size_t k = 0; k < map.knots.size(); ++k) {
    const Color& c = map.knots[k];
    function->AddRGBPoint(static_cast<double>(k) / static_cast<double>(map.knots.size() - 1), c[0] / 255.0,
                          c[1] / 255.0, c[2] / 255.0);
  }
  return function;
}

/// Relative luminance of a colour of sRGB.
double lightOf(const Color& color) {
  constexpr std::array weights{0.2126, 0.7152, 0.0722};
  double light = 0.0;
  for (std::size_t c = 0; c < weights.size(); ++c) {
    const double part = color[c] / 255.0;
    light += weights[c] * (part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4));
  }
  return light;
}

}  // namespace

double contrastOf(const Color& a, const Color& b) {
  const auto [dark, bright] = std::minmax({lightOf(a), lightOf(b)});
  return (bright + 0.05) / (dark + 0.05);
}

const std::vector<std::string>& colormapNames() {
  static const std::vector<std::string> names{"viridis",  "cividis", "batlow", "grey",
                                              "coolwarm", "turbo",   "rainbow"};
  return names;
}

const std::vector<std::string>& colormapChoices() {
  static const std::vector<std::string> choices = [] {
    std::vector<std::string> all{kAutomaticColormap};
    all.insert(all.end(), colormapNames().begin(), colormapNames().end());
    return all;
  }();
  return choices;
}

bool isDiverging(const std::string& colormap) {
  const auto map = colormaps().find(colormap);
  return map != colormaps().end() && map->second.space == Colormap::Space::Diverging;
}

ColorScale::ColorScale(const std::string& colormap, const std::array<double, 2>& range, int bands,
                       std::optional<double> middle)
    : range_(range) {
  const auto map = colormaps().find(colormap);
  if (map == colormaps().end())
    throw Error(fmt::format("colormap: found \"{}\"; allowed: {}.{}", colormap,
                            fmt::join(colormapNames(), ", "), didYouMean(colormap, colormapNames())));
  if (bands < 0 || bands > kMostBands)
    throw Error(fmt::format("bands: found {}; expected 0 (smooth) to {}", bands, kMostBands));
  if (!isDrawableRange(range))
    throw Error(fmt::format("range: found {}, {}; expected {}", range[0], range[1], kDrawableRangeWords));
  const auto function = transferFunction(map->second);
  const int count = bands == 0 ? kSmoothColors : bands;
  // The part of the map that the range takes.
  const double half = middle ? std::max(range[1] - *middle, *middle - range[0]) : 0.0;
  const double begin = middle ? 0.5 + 0.5 * (range[0] - *middle) / half : 0.0;
  const double end = middle ? 0.5 + 0.5 * (range[1] - *middle) / half : 1.0;
  const auto sampled = [&](int number) {
    std::vector<Color> colors;
    for (int k = 0; k < number; ++k) {
      const double place = number == 1 ? 0.5 : static_cast<double>(k) / (number - 1);
      const double* rgb = function->GetColor(begin + (end - begin) * place);
      const auto byte = [](double x) { return static_cast<unsigned char>(std::lround(255.0 * x)); };
      colors.push_back({byte(rgb[0]), byte(rgb[1]), byte(rgb[2])});
    }
    return colors;
  };
  colors_ = sampled(count);
  const bool isStraight = !middle && map->second.space == Colormap::Space::Rgb;
  joints_ =
      bands > 0 ? colors_ : sampled(isStraight ? static_cast<int>(map->second.knots.size()) : kJointsOfBent);
}

Color ColorScale::color(double value) const {
  const double place = (value - range_[0]) / (range_[1] - range_[0]);
  const auto count = static_cast<double>(colors_.size());
  return colors_[static_cast<std::size_t>(std::clamp(std::floor(place * count), 0.0, count - 1.0))];
}

vtkSmartPointer<vtkLookupTable> ColorScale::table() const {
  const auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(static_cast<vtkIdType>(colors_.size()));
  table->SetTableRange(range_[0], range_[1]);
  for (std::size_t k = 0; k < colors_.size(); ++k) {
    const Color& c = colors_[k];
    table->SetTableValue(static_cast<vtkIdType>(k), c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
  }
  return table;
}

}  // namespace burnish
