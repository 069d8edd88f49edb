#pragma once
#include <array>
#include <string>
#include <vector>

namespace burnish {

/// Marks of a scale at round values (1, 2, 2.5 or 5 times a power of ten apart).
struct Ticks {
  std::vector<double> values;       ///< increasing, within the range
  std::vector<std::string> labels;  ///< one per value, divided by 10^exponent
  int exponent = 0;                 ///< 0 unless the labels would be long without it
};

/// Of the first decimal digit; 0 of zero.
int decimalExponent(double value);

/// At most `most` (>= 2) marks for an increasing range.
Ticks makeTicks(const std::array<double, 2>& range, int most);

/// Marks at some of the borders of equally wide bands that an increasing range is cut into, every one, every second, ... of
/// them from its lower end, at most `most` (>= 2). Labels have as many decimals as show where these are.
Ticks makeTicksOfBands(const std::array<double, 2>& range, int bands, int most);

/// A mark at a value alone, with its exponent as of others of the range.
Ticks makeTickAt(double value, const std::array<double, 2>& range, int digits);

/// A whole number in small raised digits: ⁻¹².
std::string superscript(int number);

/// A number with `digits` significant digits as one sets it: −0.0123, 1.5×10⁻⁷.
std::string numberText(double value, int digits);

}  // namespace burnish
