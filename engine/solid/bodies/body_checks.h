#pragma once
#include "engine/schema/coordinates.h"
#include "engine/schema/problems.h"

/// Checks that shapes of the body share.
namespace burnish::inline solid {

/// Keys `inner_radius` and `outer_radius`.
void requireRing(const Problems& problems, double innerRadius, double outerRadius);

/// Key `opening_angle`, degrees; `whole`: "disc" and so on.
void requireOpening(const Problems& problems, double angle, const char* whole);

/// A direction has a length.
void requireDirection(const Problems& problems, const char* key, const Direction& direction);

}  // namespace burnish::inline solid
