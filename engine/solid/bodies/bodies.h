#pragma once
#include <variant>

#include "engine/solid/bodies/annulus.h"
#include "engine/solid/bodies/ball_octant.h"
#include "engine/solid/bodies/box.h"
#include "engine/solid/bodies/control_net.h"
#include "engine/solid/bodies/cylinder.h"
#include "engine/solid/bodies/disc.h"
#include "engine/solid/bodies/ellipse.h"
#include "engine/solid/bodies/rectangle.h"
#include "engine/solid/bodies/tube.h"

namespace burnish {

/// The shapes of a patch of the body, in the order in which they are documented. Each has a `kind`, a
/// `describe` and the exact `patch` of its dimension on the coarsest basis, and a `check` if its keys may
/// contradict one another.
using BodyShape = std::variant<RectangleBody,   //
                               AnnulusBody,     //
                               DiscBody,        //
                               EllipseBody,     //
                               BoxBody,         //
                               TubeBody,        //
                               CylinderBody,    //
                               BallOctantBody,  //
                               ControlNetBody>;

}  // namespace burnish
