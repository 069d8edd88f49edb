#pragma once
#include "engine/solid/body.h"

namespace burnish::inline solid {

/// Whether so many Gauss points per direction and span leave no motion but rigid ones without stiffness: one more than the
/// degree, or as many as the degree where splines with simple knots have two spans and more, because such functions vanish
/// at all of these points nowhere. Both keep the order of convergence: p points are exact up to degree 2p-1.
template <int Dim>
bool isHeldBy(int pointsPerDirection, const Body<Dim>& body);

}  // namespace burnish::inline solid
