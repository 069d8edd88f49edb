#pragma once
#include <bit>
#include <cmath>

/// Numbers of several points that are computed with at once, one in each lane of the processor's vector
/// registers. What a lane holds depends on no other lane.
namespace burnish {

inline constexpr int kLanes = 4;
using Lanes [[gnu::vector_size(kLanes * sizeof(double))]] = double;

/// Answers of a comparison: all bits of a lane, or none.
using LaneMask [[gnu::vector_size(kLanes * sizeof(long))]] = long;

inline bool any(LaneMask mask) {
  long all = 0;
  for (int k = 0; k < kLanes; ++k) all |= mask[k];
  return all != 0;
}

inline Lanes abs(Lanes x) {
  return x < 0.0 ? -x : x;
}

inline Lanes sqrt(Lanes x) {
  Lanes root;
  for (int k = 0; k < kLanes; ++k) root[k] = std::sqrt(x[k]);
  return root;
}

using std::expm1;

/// exp(x) − 1 to some 1e-16 of its value: with x = k ln 2 + r, |r| <= ln 2 / 2, it is 2^k (exp(r) − 1) + 2^k − 1.
inline Lanes expm1(Lanes x) {
  constexpr double kInverseLn2 = 1.4426950408889634;
  constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;
  constexpr double kRounding = 0x1.8p52;  // added to a number it leaves no digits behind the point
  constexpr double kLargest = 700.0;
  x = x > kLargest ? Lanes{} + kLargest : x;
  x = x < -kLargest ? Lanes{} - kLargest : x;
  const Lanes rounded = x * kInverseLn2 + kRounding;
  const Lanes k = rounded - kRounding;
  const Lanes r = (x - k * kLn2High) - k * kLn2Low;
  Lanes series = Lanes{} + 1.0 / 6227020800.0;
  double reciprocal = 1.0 / 6227020800.0;  // of the factorials, from 13! on
  for (int n = 13; n > 1; --n) {
    reciprocal *= n;
    series = series * r + reciprocal;
  }
  const Lanes power =
      std::bit_cast<Lanes>((std::bit_cast<LaneMask>(rounded) << 52) + std::bit_cast<LaneMask>(Lanes{} + 1.0));
  return power * (series * r) + (power - 1.0);
}

}  // namespace burnish
