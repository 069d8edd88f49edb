#pragma once
#include <array>

#include "engine/results/result.h"

/// Small models with fields that are known exactly, as if a run had written them.
namespace burnish::samples {

struct Sample {
  ModelRecord model;
  FrameRecord frame;
};

/// A slab 3 x 1 of quadratic B-splines with so many knot spans along and up, pressed down by 0.15 under a
/// disc of radius 0.5. With s = x/3, t = y of the undeformed slab: `plastic_strain` = 4 s (1-s) t²,
/// displacement (0, -0.6 s (1-s) t).
Sample slab(const std::array<int, 2>& spans = {12, 6});

/// The slab, whose upper face the disc rubs: contact pressure max(0, 10 - 40 |s - 1/2|) MPa, traction of
/// friction (0.3, 0) times that, sticking within |s - 1/2| < 0.1 and slipping elsewhere under pressure, slip
/// (0.02, 0) where it slips, way slipped s mm. Four points per knot span, equally spaced.
Sample rubbedSlab();

/// A quarter of a ring, radii 1 and 2, NURBS with so many knot spans across and around: `von_mises` = 100 (r
/// - 1) in MPa; at rest, no tool.
Sample ring(const std::array<int, 2>& spans = {4, 6});

/// A square of cubic Lagrange elements under a plane tool, sheared by u_x = 0.2 y; `pressure` = 1e-5 (x³ - y)
/// and `stress` with xx = -1e5 x, others 0, of the undeformed square.
Sample square();

/// A cube of so many knot spans in every direction under a sphere, at rest; `pressure` = x + y + z.
Sample cube(int spans = 3);

/// The slab, as the body `block`, and beside it at rest the square [3.5, 4.5] x [0, 1], as the body `stamp`.
/// `plastic_strain` is the block's alone; `von_mises` = 10 X of the undeformed bodies in both.
Sample twoBodies();

/// The first sample after its body was meshed anew: the frame of the second one with its mesh.
Sample meshedAnew(const Sample& before, const Sample& after);

}  // namespace burnish::samples
