#pragma once
#include <concepts>
#include <variant>
#include <vector>

#include "engine/solid/bodies/annulus.h"
#include "engine/solid/bodies/ball_octant.h"
#include "engine/solid/bodies/box.h"
#include "engine/solid/bodies/control_net.h"
#include "engine/solid/bodies/coons.h"
#include "engine/solid/bodies/cylinder.h"
#include "engine/solid/bodies/disc.h"
#include "engine/solid/bodies/ellipse.h"
#include "engine/solid/bodies/extrusion.h"
#include "engine/solid/bodies/rectangle.h"
#include "engine/solid/bodies/revolution.h"
#include "engine/solid/bodies/sweep.h"
#include "engine/solid/bodies/tube.h"

namespace burnish::inline solid {

/// The shapes of a patch of the body, in the order in which they are documented. Each has a `kind`, a
/// `describe` and the exact `patch` of its dimension on the coarsest basis, and a `check` if its keys may
/// contradict one another. Those that bring their own knots say so by `knotVectors` (and `dim`), and name the keys of
/// the curves and faces that they are made from in `nets`.
using BodyShape = std::variant<RectangleBody,   //
                               AnnulusBody,     //
                               DiscBody,        //
                               EllipseBody,     //
                               BoxBody,         //
                               TubeBody,        //
                               CylinderBody,    //
                               BallOctantBody,  //
                               ExtrusionBody,   //
                               RevolutionBody,  //
                               SweepBody,       //
                               CoonsBody,       //
                               ControlNetBody>;

/// A shape with knots of its own, of which a mesh divides the spans; others have one span in each direction. `dim`: 0
/// if it is not known; then, and if the shape is not sound, `knotVectors` may throw `Error`.
template <class Shape>
concept BringsKnots = requires(const Shape& shape) {
  { shape.knotVectors() } -> std::same_as<std::vector<KnotVector>>;
  { shape.dim() } -> std::same_as<int>;
};

}  // namespace burnish::inline solid
