#pragma once
#include <algorithm>
#include <array>

#include "engine/scene/tool_spec.h"
#include "engine/schema/leaf.h"

namespace burnish {

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
void describe(Visitor& v, PlaneToolSpec& s) {
  v.field("origin", s.origin, {.required = true, .perDimension = true, .unit = "length"},
          "A point of the plane.");
  v.field("normal", s.normal, {.required = true, .perDimension = true},
          "Direction from the tool towards the body, of any length.");
}

template <class Visitor>
void describe(Visitor& v, CylinderToolSpec& s) {
  v.field("center", s.center, {.required = true, .perDimension = true, .unit = "length"},
          "A point of the axis.");
  v.field("radius", s.radius, {.required = true, .above = 0, .unit = "length"}, "Radius.");
  v.field("axis", s.axis, {.minEntries = 3, .maxEntries = 3},
          "Direction of the axis; always z in two dimensions.");
}

template <class Visitor>
void describe(Visitor& v, SphereToolSpec& s) {
  v.field("center", s.center, {.required = true, .perDimension = true, .unit = "length"}, "Centre.");
  v.field("radius", s.radius, {.required = true, .above = 0, .unit = "length"}, "Radius.");
}

inline constexpr const char* kTipSentence = "Foremost point of the rounded tip.";
inline constexpr const char* kFrontSentence = "Direction from the tool to the front, of any length.";
inline constexpr const char* kRoundingSentence = "Radius of the rounding; sharp when 0.";
inline constexpr const char* kSmoothingSentence =
    "Spacing of the grid on which the distance is made smooth, and about the radius that sharp edges get; "
    "when left out the typical length of an edge, at most 1/32 of the smallest extent, of an open surface "
    "1/256 of the largest.";

template <class Visitor>
void describe(Visitor& v, EdgeToolSpec& s) {
  v.field("tip", s.tip, {.required = true, .perDimension = true, .unit = "length"}, kTipSentence);
  v.field("direction", s.direction, {.required = true, .perDimension = true}, kFrontSentence);
  v.field("angle", s.angle, {.required = true, .above = 0, .below = 180, .unit = "degrees"},
          "Angle between the flanks.");
  v.field("radius", s.radius, {.atLeast = 0, .unit = "length"}, kRoundingSentence);
  v.field("along", s.along, {.minEntries = 3, .maxEntries = 3},
          "Direction along the edge; always z in two dimensions.");
}

template <class Visitor>
void describe(Visitor& v, ConeToolSpec& s) {
  v.field("tip", s.tip, {.required = true, .perDimension = true, .unit = "length"}, kTipSentence);
  v.field("direction", s.direction, {.required = true, .perDimension = true}, kFrontSentence);
  v.field("half_angle", s.halfAngle, {.required = true, .above = 0, .below = 90, .unit = "degrees"},
          "Angle between the axis and the flank.");
  v.field("radius", s.radius, {.atLeast = 0, .unit = "length"}, kRoundingSentence);
}

template <class Visitor>
void describe(Visitor& v, TorusToolSpec& s) {
  v.field("center", s.center, {.required = true, .perDimension = true, .unit = "length"}, "Centre.");
  v.field("radius", s.radius, {.required = true, .above = 0, .unit = "length"},
          "Radius of the circle in the middle of the tube.");
  v.field("tube_radius", s.tubeRadius, {.required = true, .above = 0, .unit = "length"},
          "Radius of the tube, smaller than the radius.");
  v.field("axis", s.axis, {.minEntries = 3, .maxEntries = 3}, "Direction of the axis.");
}

template <class Visitor>
void describe(Visitor& v, BoxToolSpec& s) {
  v.field("center", s.center, {.required = true, .perDimension = true, .unit = "length"}, "Centre.");
  v.field("size", s.size, {.required = true, .above = 0, .perDimension = true, .unit = "length"},
          "Lengths of the edges, rounding included.");
  v.field("radius", s.radius, {.atLeast = 0, .unit = "length"},
          "Radius of the rounding of edges and corners, at most half the smallest size; sharp when 0.");
  v.field("axes", s.axes, {},
          "Direction of the first edge, in three dimensions also of the second, which is made perpendicular "
          "to it; along x, y, z when left out.");
}

template <class Visitor>
void describe(Visitor& v, NurbsToolSpec& s) {
  v.field("file", s.file, {},
          "YAML file that holds degrees, knots, points and weights, beside the scene; instead of giving them "
          "here.");
  v.field("degrees", s.degrees, {.atLeast = 1, .atMost = 10, .minEntries = 1, .maxEntries = 2},
          "Degree in the direction of a curve (two dimensions), in both directions of a surface (3D).");
  v.field("knots", s.knots, {.minEntries = 1, .maxEntries = 2}, "An open knot vector for each direction.");
  v.field("points", s.points, {.minEntries = 2, .unit = "length"},
          "Coordinates of the control points, the first direction fastest. The tool is to the left of a "
          "curve, behind a surface whose parameters go counterclockwise.");
  v.field("weights", s.weights, {.above = 0}, "One weight per control point; all 1 when left out.");
  v.field("flip", s.flip, {}, "The tool is on the other side.");
}

template <class Visitor>
void describe(Visitor& v, PolylineToolSpec& s) {
  v.field("file", s.file, {},
          "Text file with x and y of a point in every line, beside the scene; instead of points.");
  v.field("points", s.points, {.minEntries = 2, .unit = "length"}, "Coordinates of the points.");
  v.field("closed", s.closed, {},
          "Whether the last point is joined to the first. The tool is inside a closed line, to the left of "
          "an open one.");
  v.field("smoothing", s.smoothing, {.above = 0, .unit = "length"}, kSmoothingSentence);
}

template <class Visitor>
void describe(Visitor& v, MeshToolSpec& s) {
  v.field("file", s.file, {.required = true},
          "Triangulated surface, beside the scene: STL, OBJ, PLY or OFF.");
  v.field("scale", s.scale, {.above = 0}, "Factor on the coordinates of the file.");
  v.field("open", s.open, {},
          "Whether the surface may have a rim; the tool is then behind its triangles, whose corners go "
          "counterclockwise seen from the front.");
  v.field("smoothing", s.smoothing, {.above = 0, .unit = "length"}, kSmoothingSentence);
}

inline std::array<Alternative, 10> toolPartShapes() {
  return {{{"plane", "The half space behind a plane."},
           {"cylinder", "A cylinder of infinite length; a disc in two dimensions."},
           {"sphere", "A sphere (3D)."},
           {"edge", "A wedge between two half planes, its edge rounded."},
           {"cone", "A circular cone with a rounded tip (3D and axisymmetry)."},
           {"torus", "A torus (3D)."},
           {"box", "A box with rounded edges; a rectangle in two dimensions."},
           {"nurbs", "A NURBS curve; a NURBS surface in 3D."},
           {"polyline", "A line through points, in two dimensions."},
           {"mesh", "A triangulated surface (3D)."}}};
}

inline std::array<Alternative, 11> toolShapes() {
  std::array<Alternative, 11> shapes;
  std::ranges::copy(toolPartShapes(), shapes.begin());
  shapes.back() = {"union", "Several shapes as one."};
  return shapes;
}

inline constexpr const char* kInsideSentence =
    "The tool fills the space around the shape, and the body is in the hollow: a die.";

template <class Visitor>
void describe(Visitor& v, ToolPartSpec& s) {
  v.alternatives("shape", s.shape, toolPartShapes(), "Shape of the part.");
  v.field("inside", s.inside, {}, kInsideSentence);
}

template <class Visitor>
void describe(Visitor& v, UnionToolSpec& s) {
  v.field("parts", s.parts, {.required = true, .minEntries = 1},
          "The shapes; where they overlap they are one.");
  v.field("blend", s.blend, {.atLeast = 0, .unit = "length"},
          "Length over which the seam between two parts is filled smoothly; sharp when 0.");
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
  v.field("moment", s.moment, {.unit = "force times length"}, "Moment about the axis through the pivot.");
  v.field("schedule", s.schedule, {}, "Factor over time; 1 when left out.");
}

template <class Visitor>
void describe(Visitor& v, ToolSpec& s) {
  v.field("name", s.name, {.required = true, .identifier = true},
          "Name in contact pairs, file names and columns of the history; different for every tool.");
  v.alternatives("shape", s.shape, toolShapes(), "Shape of the tool, at its position before the motion.");
  v.field("inside", s.inside, {}, kInsideSentence);
  v.field("pivot", s.pivot, {.perDimension = true, .unit = "length"},
          "Point about which the tool turns and moments are taken; it moves with the tool. The middle of the "
          "shape when left out.");
  v.field("pivot_axis", s.pivotAxis, {.minEntries = 3, .maxEntries = 3},
          "Direction of the axis about which the tool turns; always z in two dimensions.");
  v.field("motion", s.motion, {},
          "Motion over time as a table; at rest when left out, and so is a component left out.");
  v.field("prescribe", s.prescribe, {}, "Motion as formulas in t, instead of a table.");
  v.field(
      "carry", s.carry, {},
      "Forces and moment, formulas in t, that press the tool on the body; in these ways it is free to move.");
}

}  // namespace burnish
