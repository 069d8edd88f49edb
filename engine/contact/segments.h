#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "engine/contact/master_surface.h"
#include "engine/nurbs/patch.h"

namespace burnish::inline contact {

/// A part of a span of a plane slave face whose points have their feet on one span of the master, or on one
/// kink, or no partner.
struct Segment {
  double begin = 0.0, end = 0.0;        ///< parameters of the slave
  std::optional<SurfacePlace<2>> foot;  ///< of its middle; none without partner
};

/// Cuts a span at the preimages of the master's knots, kinks and ends, so that R_b(η̄(ξ)) is smooth in every
/// segment and forces on the master are integrated like those on the slave. Halves intervals between points
/// whose feet lie on different spans; parts below a share of 1e-9 of the span are left out. footAt: foot of a
/// parameter's position, none without partner.
std::vector<Segment> segmentsOf(double begin, double end,
                                const std::function<std::optional<Foot<2>>(double)>& footAt);

/// Points of a rule per segment: degree + 1, exact on a straight face of equal weights; twice the degree on
/// any other.
int segmentPoints(const Patch<1, 2>& slave);

}  // namespace burnish::inline contact
