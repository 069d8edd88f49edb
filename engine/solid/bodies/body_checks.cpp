#include "engine/solid/bodies/body_checks.h"

#include <fmt/format.h>

namespace burnish::inline solid {

void requireRing(const Problems& problems, double innerRadius, double outerRadius) {
  if (problems.clean("inner_radius") && problems.clean("outer_radius") && outerRadius <= innerRadius)
    problems.report("outer_radius", fmt::format("found {}; allowed: a number above the inner radius {}.",
                                                outerRadius, innerRadius));
}

void requireOpening(const Problems& problems, double angle, const char* whole) {
  if (problems.clean("opening_angle") && angle >= 180.0 && angle != 360.0)
    problems.report("opening_angle",
                    fmt::format("found {}; allowed: a number above 0 and below 180, or 360 for the whole {}.",
                                angle, whole));
}

void requireDirection(const Problems& problems, const char* key, const Direction& direction) {
  if (problems.clean(key) && direction.isZero(0.0))
    problems.report(key, "found a vector of length 0; allowed: a direction, such as [0, 0, 1].");
}

}  // namespace burnish::inline solid
