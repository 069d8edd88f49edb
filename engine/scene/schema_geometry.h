#pragma once
#include "engine/scene/scene.h"
#include "engine/schema/leaf.h"

namespace burnish {

template <class Visitor>
void describe(Visitor& v, RectangleSpec& s) {
  v.field("origin", s.origin, {.perDimension = true, .unit = "length"}, "Lower left corner.");
  v.field("size", s.size, {.required = true, .above = 0, .perDimension = true, .unit = "length"},
          "Width and height.");
}

template <class Visitor>
void describe(Visitor& v, AnnulusSpec& s) {
  v.field("center", s.center, {.perDimension = true, .unit = "length"}, "Centre of the ring.");
  v.field("inner_radius", s.innerRadius, {.required = true, .above = 0, .unit = "length"},
          "Radius of the face `left`.");
  v.field("outer_radius", s.outerRadius, {.required = true, .above = 0, .unit = "length"},
          "Radius of the face `right`; greater than the inner radius.");
  v.field("start_angle", s.startAngle, {.atLeast = -360, .atMost = 360, .unit = "degrees"},
          "Angle of the face `bottom` from the x axis, counterclockwise.");
  v.field("opening_angle", s.openingAngle, {.above = 0, .below = 180, .unit = "degrees"},
          "Angle from the face `bottom` to the face `top`, counterclockwise.");
}

template <class Visitor>
void describe(Visitor& v, DiscSpec& s) {
  v.field("center", s.center, {.perDimension = true, .unit = "length"}, "Centre of the disc.");
  v.field("radius", s.radius, {.required = true, .above = 0, .unit = "length"}, "Radius.");
  v.field("start_angle", s.startAngle, {.atLeast = -360, .atMost = 360, .unit = "degrees"},
          "Angle of the face `bottom` of a sector, of the middle of the face `right` of a whole disc, from "
          "the x axis, counterclockwise.");
  v.field("opening_angle", s.openingAngle, {.above = 0, .atMost = 360, .unit = "degrees"},
          "360: the whole disc; its faces `right`, `top`, `left` and `bottom` are quarters of the circle. "
          "Below 180: the angle of a sector from the straight face `bottom` to the straight face `left`, "
          "with the faces `right` and `top` along its arc.");
}

template <class Visitor>
void describe(Visitor& v, EllipseSpec& s) {
  v.field("center", s.center, {.perDimension = true, .unit = "length"}, "Centre of the ellipse.");
  v.field("size", s.size, {.required = true, .above = 0, .perDimension = true, .unit = "length"},
          "Width and height, along x and y; the faces are named as those of a whole disc.");
}

template <class Visitor>
void describe(Visitor& v, BoxSpec& s) {
  v.field("origin", s.origin, {.perDimension = true, .unit = "length"},
          "Corner with the smallest coordinates.");
  v.field("size", s.size, {.required = true, .above = 0, .perDimension = true, .unit = "length"},
          "Edge lengths in x, y and z.");
}

template <class Visitor>
void describe(Visitor& v, TubeSpec& s) {
  v.field("center", s.center, {.perDimension = true, .unit = "length"}, "Begin of the axis.");
  v.field("axis", s.axis, {.perDimension = true},
          "Direction of the axis, from the face `back` to the face `front`.");
  v.field("inner_radius", s.innerRadius, {.required = true, .above = 0, .unit = "length"},
          "Radius of the face `left`.");
  v.field("outer_radius", s.outerRadius, {.required = true, .above = 0, .unit = "length"},
          "Radius of the face `right`; greater than the inner radius.");
  v.field("length", s.length, {.required = true, .above = 0, .unit = "length"}, "Length of the axis.");
  v.field("start_angle", s.startAngle, {.atLeast = -360, .atMost = 360, .unit = "degrees"},
          "Angle of the face `bottom` about the axis, from the coordinate axis that follows the largest "
          "component of `axis`: x for an axis along z, y along x, z along y.");
  v.field("opening_angle", s.openingAngle, {.above = 0, .below = 180, .unit = "degrees"},
          "Angle from the face `bottom` to the face `top`.");
}

template <class Visitor>
void describe(Visitor& v, CylinderSpec& s) {
  v.field("center", s.center, {.perDimension = true, .unit = "length"}, "Begin of the axis.");
  v.field("axis", s.axis, {.perDimension = true},
          "Direction of the axis, from the face `back` to the face `front`.");
  v.field("radius", s.radius, {.required = true, .above = 0, .unit = "length"}, "Radius.");
  v.field("length", s.length, {.required = true, .above = 0, .unit = "length"}, "Length of the axis.");
  v.field("start_angle", s.startAngle, {.atLeast = -360, .atMost = 360, .unit = "degrees"},
          "Angle about the axis of the face `bottom` of a sector, of the middle of the face `right` of a "
          "whole cylinder; counted as that of a tube.");
  v.field("opening_angle", s.openingAngle, {.above = 0, .atMost = 360, .unit = "degrees"},
          "360: the whole cylinder, with the faces `right`, `top`, `left` and `bottom` around its surface. "
          "Below 180: the angle of a sector from the plane face `bottom` to the plane face `left`, with the "
          "faces `right` and `top` along its surface.");
}

template <class Visitor>
void describe(Visitor& v, BallOctantSpec& s) {
  v.field("center", s.center, {.perDimension = true, .unit = "length"}, "Centre of the ball.");
  v.field("radius", s.radius, {.required = true, .above = 0, .unit = "length"}, "Radius.");
  v.field("pole", s.pole, {.perDimension = true},
          "Direction from the centre to the middle of the half ball. The planes of symmetry `bottom` and "
          "`back` meet there, at a corner of the sphere `right`; `top` is the plane through the centre.");
}

template <class Visitor>
void describe(Visitor& v, ControlNetSpec& s) {
  v.field("file", s.file, {},
          "YAML file that holds the other keys of the control net, beside the scene; instead of giving them "
          "here.");
  v.field("degrees", s.degrees, {.atLeast = 1, .atMost = 10, .minEntries = 2, .maxEntries = 3},
          "Degree in each of the two or three parametric directions.");
  v.field("knots", s.knots, {.minEntries = 2, .maxEntries = 3}, "An open knot vector for each direction.");
  v.field("points", s.points, {.minEntries = 4, .unit = "length"},
          "Coordinates of the control points, the first direction fastest.");
  v.field("weights", s.weights, {.above = 0}, "One weight per control point; all 1 when left out.");
}

template <class Visitor>
void describe(Visitor& v, MeshSpec& s) {
  v.field("functions", s.functions, {.atLeast = 2, .atMost = 10000, .perDimension = true},
          "Number of basis functions in each direction; give either this or spans.");
  v.field("spans", s.spans, {.atLeast = 1, .atMost = 10000, .perDimension = true},
          "Number of knot spans (elements) in each direction.");
  v.field("refine", s.refine, {.atLeast = 1, .atMost = 10000, .perDimension = true},
          "Of a control net: parts into which every knot span is divided, in each direction.");
  v.field("grading", s.grading, {.perDimension = true},
          "A formula in s for each direction that takes equally spaced breakpoints s from 0 to 1 to graded "
          "ones, such as s^2.");
  v.field("creases", s.creases, {.perDimension = true},
          "For each direction the breakpoints, from 0 to 1, at which NURBS are continuous only.");
}

template <class Visitor>
void describe(Visitor& v, PatchSpec& s) {
  v.field("name", s.name, {.required = true, .identifier = true},
          "Name for supports, loads, contact and measures; different for every patch.");
  v.alternatives("shape", s.shape,
                 {{{"rectangle", "A rectangle along the axes."},
                   {"annulus", "Part of a ring: radius first, then angle."},
                   {"disc", "A disc, whole or a sector of it."},
                   {"ellipse", "A whole ellipse with axes along x and y."},
                   {"box", "A box along the axes."},
                   {"tube", "Part of a tube: radius first, then angle, then axis."},
                   {"cylinder", "A solid cylinder, whole or a sector of it; third direction along the axis."},
                   {"ball-octant", "An eighth of a ball: half of it, cut by two planes of symmetry."},
                   {"control-net", "Control points, weights and knots; needs no functions or spans."}}},
                 "Kind of patch.");
  describe(v, s.mesh);
}

template <class Visitor>
void describe(Visitor& v, PatchesSpec& s) {
  v.field("patches", s.patches, {.required = true, .minEntries = 1},
          "The patches; where faces of two of them have the same control points, they are joined.");
}

template <class Visitor>
void describe(Visitor& v, GeometrySpec& s) {
  v.alternatives("shape", s.shape,
                 {{{"rectangle", "A rectangle along the axes."},
                   {"annulus", "Part of a ring: radius first, then angle."},
                   {"disc", "A disc, whole or a sector of it."},
                   {"ellipse", "A whole ellipse with axes along x and y."},
                   {"box", "A box along the axes."},
                   {"tube", "Part of a tube: radius first, then angle, then axis."},
                   {"cylinder", "A solid cylinder, whole or a sector of it; third direction along the axis."},
                   {"ball-octant", "An eighth of a ball: half of it, cut by two planes of symmetry."},
                   {"control-net", "Control points, weights and knots; needs no functions or spans."},
                   {"patches", "Several patches, joined at common faces; each has its own mesh."}}},
                 "Kind of body.");
  describe(v, s.mesh);
}

}  // namespace burnish
