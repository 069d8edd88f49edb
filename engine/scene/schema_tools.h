#pragma once
#include "engine/scene/tool_spec.h"
#include "engine/schema/leaf.h"

namespace burnish::inline scene {

template <class Visitor>
void describe(Visitor& v, Schedule& s) {
  v.field("times", s.times, {.required = true, .increasing = true, .minEntries = 1, .unit = "time"},
          "Points in time; the values are linear in between and constant outside.");
  v.field("values", s.values, {.required = true, .minEntries = 1}, "One value for each of the times.");
}

template <class Visitor>
void describe(Visitor& v, MotionSpec& s) {
  v.field("times", s.times, {.required = true, .increasing = true, .minEntries = 1, .unit = "time"},
          "Points in time; the displacements are linear in between and constant outside.");
  v.field("x", s.x, {.unit = "length"}, "Displacement in x at each of the times.");
  v.field("y", s.y, {.unit = "length"}, "Displacement in y at each of the times.");
  v.field("z", s.z, {.unit = "length"}, "Displacement in z at each of the times (3D).");
}

template <class Visitor>
void describe(Visitor& v, ToolMotionSpec& s) {
  v.field("times", s.times, {.required = true, .increasing = true, .minEntries = 1, .unit = "time"},
          "Points in time; the motion is linear in between and constant outside.");
  v.field("x", s.x, {.unit = "length"}, "Displacement in x at each of the times.");
  v.field("y", s.y, {.unit = "length"}, "Displacement in y at each of the times.");
  v.field("z", s.z, {.unit = "length"}, "Displacement in z at each of the times (3D).");
  v.field("angle", s.angle, {.unit = "degrees"},
          "Turn about the axis through the pivot at each of the times; counter-clockwise where the axis "
          "points at the reader.");
}

template <class Visitor>
void describe(Visitor& v, ToolPrescribedSpec& s) {
  v.field("x", s.x, {.unit = "length"}, "Displacement in x.");
  v.field("y", s.y, {.unit = "length"}, "Displacement in y.");
  v.field("z", s.z, {.unit = "length"}, "Displacement in z (3D).");
  v.field("angle", s.angle, {.unit = "degrees"}, "Turn about the axis through the pivot.");
}

template <class Visitor>
void describe(Visitor& v, ToolCarrySpec& s) {
  v.field("x", s.x, {.unit = "force"}, "Force in x; per thickness in plane strain.");
  v.field("y", s.y, {.unit = "force"}, "Force in y; on the whole ring in axisymmetry.");
  v.field("z", s.z, {.unit = "force"}, "Force in z (3D).");
  v.field(
      "normal", s.normal, {.unit = "force"},
      "Instead of x, y and z: force along the outward normal of the undeformed face, so that negative ones press, "
      "at its point next to the middle of the tool where path or motion has it; the tool is free along that alone.");
  v.field("moment", s.moment, {.unit = "force times length"}, "Moment about the axis through the pivot.");
  v.field(
      "spin", s.spin, {},
      "A ball that turns freely about all axes through its middle, as friction turns it (3D): no moment about "
      "any of them is left.");
  v.field("schedule", s.schedule, {}, "Factor over time; 1 when left out.");
}

template <class Visitor>
void describe(Visitor& v, ToolSpec& s) {
  v.field("name", s.name, {.required = true, .identifier = true},
          "Name in contact pairs, file names and columns of the history; different for every tool.");
  v.alternatives("shape", s.shape, alternativesOf(s.shape),
                 "Shape of the tool, at its position before the motion.");
  v.field("inside", s.inside, {}, kInsideSentence);
  v.field("pivot", s.pivot, {.unit = "length"},
          "Point about which the tool turns and moments are taken; it moves with the tool. The middle of the "
          "shape when left out.");
  v.field("pivot_axis", s.pivotAxis, {},
          "Direction of the axis about which the tool turns; always z in two dimensions.");
  v.field("motion", s.motion, {},
          "Motion over time as a table; at rest when left out, and so is a component left out.");
  v.field("prescribe", s.prescribe, {}, "Motion as formulas in t, instead of a table.");
  v.field("path", s.path, {}, "Motion along a path, with a speed, instead of a table.");
  v.field(
      "carry", s.carry, {},
      "Forces and moment, formulas in t, that press the tool on the body; in these ways it is free to move.");
  v.field(
      "until", s.until, {.above = 0, .unit = "time"},
      "Time at which it is taken away; stays to the end when left out. From then on it touches nothing and carries "
      "nothing, and what it pressed and rubbed its faces with goes linearly to zero, step by step in balance.");
  v.field(
      "released_by", s.releasedBy, {.above = 0, .unit = "time"},
      "Time at which the forces of a tool that is taken away are zero; the end of the run when left out.");
}

}  // namespace burnish::inline scene
