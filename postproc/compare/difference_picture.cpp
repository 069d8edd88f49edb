#include "postproc/compare/difference_picture.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "postproc/compare/lab.h"

namespace burnish {
namespace {

constexpr float kStrong = 50.0F;                       // ΔE that gets the darkest colour
constexpr float kDarkestGrey = 200.0F;                 // of the faded baseline
constexpr Color kJust{255, 150, 0}, kMost{70, 0, 20};  // get darker, so that they differ in print too

Color between(const Color& from, const Color& to, float part) {
  Color color{};
  for (std::size_t c = 0; c < color.size(); ++c) {
    const float start = from[c], end = to[c];
    color[c] = static_cast<unsigned char>(std::lround(start + part * (end - start)));
  }
  return color;
}

Color faded(const Lab& color) {
  const auto grey = static_cast<unsigned char>(
      std::lround(kDarkestGrey + (255.0F - kDarkestGrey) * std::clamp(color[0] / 100.0F, 0.0F, 1.0F)));
  return {grey, grey, grey};
}

}  // namespace

Picture differencePicture(const Picture& actual, const Picture& baseline) {
  assert(actual.width == baseline.width && actual.height == baseline.height);
  Picture picture{baseline.width, baseline.height, {}};
  picture.pixels.reserve(baseline.pixels.size());
  for (std::size_t k = 0; k < baseline.pixels.size(); ++k) {
    const Lab wanted = toLab(baseline.pixels[k]);
    const float distance = deltaE(toLab(actual.pixels[k]), wanted);
    const float part = std::min(1.0F, (distance - kVisibleDeltaE) / (kStrong - kVisibleDeltaE));
    picture.pixels.push_back(distance > kVisibleDeltaE ? between(kJust, kMost, part) : faded(wanted));
  }
  return picture;
}

}  // namespace burnish
