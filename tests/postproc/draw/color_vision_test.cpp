#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "postproc/compare/lab.h"
#include "postproc/draw/chart/chart_curves.h"
#include "postproc/draw/page/color_scale.h"

namespace burnish {
namespace {

using Seen = std::function<Lab(const Color&)>;

/// What somebody without one kind of cones sees: the simulation of Machado, Oliveira and Fernandes (2009),
/// severity 1, a matrix for linear light.
Lab seenThrough(const Eigen::Matrix3d& eyes, const Color& color) {
  const auto linear = [](double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); };
  const auto coded = [](double l) {
    return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
  };
  Eigen::Vector3d light;
  for (int c = 0; c < 3; ++c) light(c) = linear(color[static_cast<std::size_t>(c)] / 255.0);
  light = (eyes * light).cwiseMax(0.0).cwiseMin(1.0);
  Color seen;
  for (int c = 0; c < 3; ++c)
    seen[static_cast<std::size_t>(c)] = static_cast<unsigned char>(std::lround(255.0 * coded(light(c))));
  return toLab(seen);
}

struct Reader {
  std::string name;
  Seen seen;
};

std::vector<Reader> colorBlindReaders() {
  Eigen::Matrix3d noRed, noGreen, noBlue;
  noRed << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998;
  noGreen << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881;
  noBlue << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900;
  return {{"no red", [=](const Color& c) { return seenThrough(noRed, c); }},
          {"no green", [=](const Color& c) { return seenThrough(noGreen, c); }},
          {"no blue", [=](const Color& c) { return seenThrough(noBlue, c); }}};
}

Lab plainly(const Color& color) {
  return toLab(color);
}

Lab inGrey(const Color& color) {
  return {toLab(color)[0], 0.0F, 0.0F};
}

/// The least distance of two colours of a map for values at least an eighth of the range apart.
float leastDistance(const std::string& map, const Seen& seen) {
  std::vector<Lab> colors;
  const ColorScale scale(map, {0.0, 1.0}, 64);
  for (const Color& color : scale.colors()) colors.push_back(seen(color));
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t b = 8; b < colors.size(); ++b)
    for (std::size_t a = 0; a + 8 <= b; ++a) least = std::min(least, deltaE(colors[a], colors[b]));
  return least;
}

TEST(ColorVision, EveryMapButTheRainbowIsReadWithoutOneKindOfCones) {
  for (const Reader& reader : colorBlindReaders()) {
    for (const std::string& map : colormapNames())
      EXPECT_EQ(leastDistance(map, reader.seen) > 3 * kVisibleDeltaE, map != "rainbow")
          << map << ", " << reader.name;
  }
}

TEST(ColorVision, MapsForPrintAreReadInGrey) {
  for (const char* map : {"viridis", "cividis", "batlow", "grey"})
    EXPECT_GT(leastDistance(map, inGrey), 3 * kVisibleDeltaE) << map;
}

TEST(ColorVision, EndsOfADivergingMapAreToldApart) {
  const ColorScale scale("coolwarm", {-1.0, 1.0}, 0);
  for (const Reader& reader : colorBlindReaders()) {
    const Lab low = reader.seen(scale.colors().front()), high = reader.seen(scale.colors().back());
    EXPECT_GT(deltaE(low, high), 60.0F) << reader.name;
  }
}

TEST(ColorVision, CurvesAreToldApart) {
  constexpr int kColors = 7;
  for (const Reader& reader : colorBlindReaders())
    for (int a = 0; a < kColors; ++a)
      for (int b = 0; b < a; ++b)
        EXPECT_GT(deltaE(reader.seen(curveColor({.color = a})), reader.seen(curveColor({.color = b}))), 15.0F)
            << a << " " << b << ", " << reader.name;
}

TEST(ColorVision, PageHasTheseNumbers) {
  std::ostringstream page;
  page << std::ifstream(BURNISH_SOURCE_DIR "/docs/render.md").rdbuf();
  for (const std::string& map : colormapNames()) {
    std::string row = fmt::format("| `{}` | {:.0f} |", map, leastDistance(map, plainly));
    for (const Reader& reader : colorBlindReaders())
      row += fmt::format(" {:.0f} |", leastDistance(map, reader.seen));
    row += fmt::format(" {:.0f} |", leastDistance(map, inGrey));
    EXPECT_THAT(page.str(), testing::HasSubstr(row));
  }
}

}  // namespace
}  // namespace burnish
