#include "postproc/compare/lab.h"

#include <array>
#include <cmath>

namespace burnish {
namespace {

/// Light of a byte of sRGB, from 0 to 1.
std::array<float, 256> makeLinear() {
  std::array<float, 256> linear{};
  for (std::size_t k = 0; k < linear.size(); ++k) {
    const double s = static_cast<double>(k) / 255.0;
    linear[k] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  }
  return linear;
}

/// The cube root, with a straight line where it gets too steep.
float response(float t) {
  constexpr float delta = 6.0F / 29.0F;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3.0F * delta * delta) + 4.0F / 29.0F;
}

}  // namespace

Lab toLab(const Color& color) {
  static const std::array<float, 256> linear = makeLinear();
  const float r = linear[color[0]], g = linear[color[1]], b = linear[color[2]];
  // From the primaries of sRGB to X, Y, Z, in units of white: every row sums to one.
  const float x = response(0.433953F * r + 0.376219F * g + 0.189828F * b);
  const float y = response(0.212673F * r + 0.715152F * g + 0.072175F * b);
  const float z = response(0.017758F * r + 0.109477F * g + 0.872765F * b);
  return {116.0F * y - 16.0F, 500.0F * (x - y), 200.0F * (y - z)};
}

std::vector<Lab> toLab(const Picture& picture) {
  std::vector<Lab> colors;
  colors.reserve(picture.pixels.size());
  for (const Color& color : picture.pixels) {
    const std::size_t k = colors.size();
    const bool repeated = k > 0 && picture.pixels[k - 1] == color;  // most of a drawing is one colour
    colors.push_back(repeated ? colors.back() : toLab(color));
  }
  return colors;
}

float deltaE(const Lab& a, const Lab& b) {
  return (a - b).matrix().norm();
}

}  // namespace burnish
