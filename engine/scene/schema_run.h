#pragma once
#include "engine/scene/scene.h"
#include "engine/schema/leaf.h"

namespace burnish {

template <class Visitor>
void describe(Visitor& v, PhaseSpec& s) {
  v.field("until", s.until, {.required = true, .above = 0, .unit = "time"},
          "Time at which the phase ends; it begins where the one before ended, the first one at 0.");
  v.field("count", s.count, {.required = true, .atLeast = 1, .atMost = 1'000'000},
          "Number of equal nominal steps of the phase; difficult ones are cut.");
}

template <class Visitor>
void describe(Visitor& v, SolverSpec& s) {
  v.field("tolerance", s.tolerance, {.atLeast = 1e-14, .atMost = 1e-3},
          "Relative residual of a converged step.");
  v.field("max_iterations", s.maxIterations, {.atLeast = 2, .atMost = 1000},
          "Newton iterations after which a step is cut.");
  v.field("max_cuts", s.maxCuts, {.atLeast = 0, .atMost = 30},
          "The smallest step is the nominal one halved so many times.");
}

template <class Visitor>
void describe(Visitor& v, StabiliseSpec& s) {
  v.field("until", s.until, {.above = 0, .unit = "time"},
          "Time at which the drag has faded to a thousandth, which stays; the end of the first phase when "
          "left out.");
  v.field("strength", s.strength, {.above = 0, .atMost = 1},
          "Force on the body while it moves by its size in that time, over E L (E L^2 in space and "
          "axisymmetry), L its size.");
}

template <class Visitor>
void describe(Visitor& v, RezoningSpec& s) {
  v.field("travel", s.travel, {.above = 0, .unit = "length"},
          "A new mesh after so much travel of a tool; 0.16 half thicknesses of the tool when left out, or of "
          "a sixth of the body's size if that is less. What is left out below counts from the same length.");
  v.field("stretch", s.stretch, {.above = 1},
          "A new mesh earlier if the largest principal stretch since the last one exceeds this.");
  v.field("quality", s.quality, {.atLeast = 0, .below = 1},
          "A new mesh earlier if the smallest determinant of the deformed mesh's map over the largest falls "
          "below this; 0: not for this reason.");
  v.field("spans", s.spans, {.atLeast = 1, .atMost = 10'000, .perDimension = true},
          "Knot spans of new meshes per direction; as many as before when left out.");
  v.field("ahead", s.ahead, {.atLeast = 0, .unit = "length"},
          "Knot spans stay finest so far ahead of the contact, along the face; 0.4 half thicknesses of the "
          "tool when left out.");
  v.field("behind", s.behind, {.atLeast = 0, .unit = "length"},
          "The same behind it; a tenth of the tool's half thickness when left out.");
  v.field("growth", s.growth, {.above = 0, .atMost = 2},
          "Growth of the spans' size per distance from there.");
  v.field("turn", s.turn, {.atLeast = 0, .atMost = 3, .unit = "radians"},
          "Largest turn of the face within a knot span; spans are not made smaller for it than under the "
          "tool, and there not smaller than half of that. 0: any turn.");
  v.field("first_layer", s.firstLayer, {.above = 0, .atMost = 10},
          "Depth of the spans under the face, over the length of those under the tool.");
  v.field("smallest_determinant", s.smallestDeterminant, {.above = 0, .below = 1},
          "New meshes whose smallest determinant over the largest is less are not used.");
}

template <class Visitor>
void describe(Visitor& v, OutputSpec& s) {
  v.field("times", s.times, {.atLeast = 0, .increasing = true, .unit = "time"},
          "Times at which a frame is written, beside the start and the end.");
  v.field("every", s.every, {.above = 0, .unit = "time"}, "A frame every so much time.");
  v.field("subdivision", s.subdivision, {.atLeast = 1, .atMost = 64},
          "Cells per knot span and direction in VTU files and pictures.");
  v.field("vtu", s.vtu, {}, "Write VTU files, one per frame, and a PVD collection.");
  v.field("reactions", s.reactions, {},
          "Add the force of the body on every support, and its moment about the origin, to the history: "
          "columns SUPPORT.fx, ... The summary has those of the end in any case.");
}

}  // namespace burnish
