#pragma once
#include "engine/results/result.h"

/// Small models with fields that are known exactly, as if a run had written them.
namespace burnish::samples {

struct Sample {
  ModelRecord model;
  FrameRecord frame;
};

/// A slab 3 x 1 of quadratic B-splines, pressed down by 0.15 under a disc of radius 0.5. With s = x/3, t = y
/// of the undeformed slab: `plastic_strain` = 4 s (1-s) t², displacement (0, -0.6 s (1-s) t).
Sample slab();

/// A quarter of a ring, radii 1 and 2, NURBS: `von_mises` = 100 (r - 1) in MPa; at rest, no tool.
Sample ring();

/// A square of cubic Lagrange elements under a plane tool, sheared by u_x = 0.2 y; `pressure` = 1e-5 (x³ - y)
/// and `stress` with xx = -1e5 x, others 0, of the undeformed square.
Sample square();

/// A cube under a sphere, at rest; `pressure` = x + y + z.
Sample cube();

}  // namespace burnish::samples
