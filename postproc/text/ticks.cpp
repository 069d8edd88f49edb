#include "postproc/text/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace burnish {
namespace {

/// Exponents in [-kPlain, kPlain] are written out.
constexpr int kPlain = 3;

/// First and last multiple of a step in a range, ends included in spite of round-off.
std::array<double, 2> multiples(const std::array<double, 2>& range, double step) {
  constexpr double slack = 1e-9;
  return {std::ceil(range[0] / step - slack), std::floor(range[1] / step + slack)};
}

/// The smallest round step of which at most `most` multiples lie in the range.
double roundStep(const std::array<double, 2>& range, int most) {
  double power = std::pow(10.0, decimalExponent((range[1] - range[0]) / most) - 1);
  for (;; power *= 10.0) {
    for (const double factor : {1.0, 2.0, 2.5, 5.0}) {
      const auto [first, last] = multiples(range, factor * power);
      if (last - first + 1.0 <= most) return factor * power;
    }
  }
}

std::string withMinusSign(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, "−");
  return text;
}

std::string withoutTrailingZeros(std::string text) {
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

/// Of the power of ten by which numbers of a range are divided.
int exponentOf(const std::array<double, 2>& range) {
  const int largest = decimalExponent(std::max(std::abs(range[0]), std::abs(range[1])));
  return std::abs(largest) > kPlain ? 3 * static_cast<int>(std::floor(largest / 3.0)) : 0;
}

/// Decimals that the multiples of a step need.
int decimalsOf(double step) {
  int decimals = std::max(0, -decimalExponent(step));
  const double scaled = step * std::pow(10.0, decimals);
  return std::abs(scaled - std::round(scaled)) > 1e-6 ? decimals + 1 : decimals;
}

}  // namespace

int decimalExponent(double value) {
  return value == 0.0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
}

Ticks makeTicksOfBands(const std::array<double, 2>& range, int bands, int most) {
  constexpr double kVisible = 0.005;  // of a step
  const int every = std::max(1, (bands + most - 2) / (most - 1));
  Ticks ticks;
  ticks.exponent = exponentOf(range);
  const double unit = std::pow(10.0, ticks.exponent), step = every * (range[1] - range[0]) / bands;
  for (int k = 0; k <= bands; k += every)
    ticks.values.push_back(std::lerp(range[0], range[1], static_cast<double>(k) / bands));
  int decimals = 0;
  const auto isCoarse = [&](double value) {
    const double power = std::pow(10.0, decimals);
    return std::abs(std::round(value / unit * power) / power - value / unit) > kVisible * step / unit;
  };
  while (std::ranges::any_of(ticks.values, isCoarse)) ++decimals;
  for (const double value : ticks.values)
    ticks.labels.push_back(withMinusSign(fmt::format("{:.{}f}", value / unit + 0.0, decimals)));
  return ticks;
}

Ticks makeTickAt(double value, const std::array<double, 2>& range, int digits) {
  const int exponent = exponentOf(range);
  return {{value}, {numberText(value / std::pow(10.0, exponent), digits)}, exponent};
}

Ticks makeTicks(const std::array<double, 2>& range, int most) {
  const double step = roundStep(range, most);
  Ticks ticks;
  ticks.exponent = exponentOf(range);
  const double unit = std::pow(10.0, ticks.exponent);
  const int decimals = decimalsOf(step / unit);
  const auto [first, last] = multiples(range, step);
  for (int i = 0; i <= last - first; ++i) {
    const double k = first + i;
    const double value = k == 0.0 ? 0.0 : k * step;  // no negative zero
    ticks.values.push_back(std::clamp(value, range[0], range[1]));
    ticks.labels.push_back(withMinusSign(fmt::format("{:.{}f}", value / unit, decimals)));
  }
  return ticks;
}

std::string superscript(int number) {
  static constexpr std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(number)))
    text += digits[static_cast<std::size_t>(digit - '0')];
  return text;
}

std::string numberText(double value, int digits) {
  if (value == 0.0) return "0";
  const std::string scientific = fmt::format("{:.{}e}", value, digits - 1);
  const std::size_t e = scientific.find('e');
  const int exponent = std::stoi(scientific.substr(e + 1));
  if (exponent >= -kPlain && exponent <= std::max(kPlain, digits))
    return withMinusSign(
        withoutTrailingZeros(fmt::format("{:.{}f}", value, std::max(0, digits - 1 - exponent))));
  return withMinusSign(withoutTrailingZeros(scientific.substr(0, e))) + "×10" + superscript(exponent);
}

}  // namespace burnish
