#pragma once
#ifdef __AVX__
#include <immintrin.h>
#endif

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

/// Numbers that are computed with at once, one in each lane of the processor's vector registers. They are copied from
/// and to memory, and not passed by value, which without AVX is another convention for calls.
namespace burnish::inline core {

/// As many as a register holds, which is four with AVX and two without: more are carried through memory, ten times as slowly.
#ifdef __AVX__
inline constexpr int kLanes = 4;
#else
inline constexpr int kLanes = 2;
#endif
using Lanes [[gnu::vector_size(kLanes * sizeof(double))]] = double;

[[gnu::always_inline]] inline void load(const double* from, Lanes& to) {
  std::memcpy(&to, from, sizeof to);
}

[[gnu::always_inline]] inline void load(const float* from, Lanes& to) {
#ifdef __AVX__
  to = _mm256_cvtps_pd(_mm_loadu_ps(from));  // GCC 12 makes two conversions and more of the other branch
#else
  using SingleLanes [[gnu::vector_size(kLanes * sizeof(float))]] = float;
  SingleLanes values;
  std::memcpy(&values, from, sizeof values);
  to = __builtin_convertvector(values, Lanes);
#endif
}

[[gnu::always_inline]] inline void store(const Lanes& from, double* to) {
  std::memcpy(to, &from, sizeof from);
}

[[gnu::always_inline]] inline double sumOf(const Lanes& lanes) {
  double sum = 0.0;
  for (int lane = 0; lane < kLanes; ++lane) sum += lanes[lane];
  return sum;
}

/// The next multiple of the number of lanes.
constexpr std::ptrdiff_t roundedToLanes(std::ptrdiff_t n) {
  return (n + kLanes - 1) / kLanes * kLanes;
}

/// Calls f with 0 … Count-1 as compile-time constants: what a loop fills stays in registers.
template <int Count, class F>
[[gnu::always_inline]] inline void unrolled(const F& f) {
  [&]<int... K>(std::integer_sequence<int, K...>) {
    (f(std::integral_constant<int, K>{}), ...);
  }
  (std::make_integer_sequence<int, Count>{});
}

}  // namespace burnish::inline core
