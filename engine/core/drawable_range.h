#pragma once
#include <array>
#include <cmath>

namespace burnish::inline core {

/// Largest magnitude that pictures and charts show, and the smallest distance of the ends of a scale: beyond
/// them, steps and powers of ten are no longer numbers.
inline constexpr double kLargestDrawn = 1e300, kSmallestDrawnSpan = 1e-290;

/// What `isDrawableRange` allows, for messages.
inline constexpr const char* kDrawableRangeWords =
    "two numbers up to 1e300 in magnitude, the first one smaller, at least 1e-290 apart";

/// Whether a colour scale or an axis can go from the first to the second value.
inline bool isDrawableRange(const std::array<double, 2>& range) {
  return std::abs(range[0]) <= kLargestDrawn && std::abs(range[1]) <= kLargestDrawn &&
         range[1] - range[0] >= kSmallestDrawnSpan;
}

}  // namespace burnish::inline core
