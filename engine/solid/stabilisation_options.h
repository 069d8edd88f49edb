#pragma once
#include <optional>

namespace burnish::inline solid {

/// A drag on a body that nothing but contact holds, see `Stabilisation`.
struct StabilisationOptions {
  std::optional<double> until;  ///< time at which it has faded; the end of the first phase when left out
  double strength = 1e-5;  ///< force on the body that moves by its size in that time, over E L (E L² in 3D)
};

template <class Visitor>
void describe(Visitor& v, StabilisationOptions& s) {
  v.field("until", s.until, {.above = 0, .unit = "time"},
          "Time at which the drag has faded to a thousandth, which stays; the end of the first phase when "
          "left out.");
  v.field("strength", s.strength, {.above = 0, .atMost = 1},
          "Force on the body while it moves by its size in that time, over E L (E L^2 in space and "
          "axisymmetry), L its size.");
}

}  // namespace burnish::inline solid
