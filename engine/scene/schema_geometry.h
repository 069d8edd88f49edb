#pragma once
#include "engine/scene/scene.h"
#include "engine/schema/leaf.h"

namespace burnish::inline scene {

template <class Visitor>
void describe(Visitor& v, ReliefSpec& s) {
  v.field("face", s.face, {.required = true}, "left, right, bottom, top, and in space back, front.");
  v.field(
      "height", s.height, {.unit = "length"},
      "Formula in X, Y, Z, the place on the face without it: how far the face is moved outwards there, such as "
      "0.002 * cos(2 * _pi * X / 0.1).");
  v.field(
      "file", s.file, {},
      "CSV file with a profile that was measured, instead of height: a first row with the names of two columns, places "
      "along the profile and heights, whose units may stand in brackets; relative to the scene.");
  v.field("places", s.places, {.unit = "length"}, "Instead of a file: increasing places along the profile.");
  v.field("heights", s.heights, {.unit = "length"}, "Of that profile: one per place; straight between them.");
  v.field(
      "along", s.along, {.unit = "length"},
      "Formula in X, Y, Z, the place on the face without it: where in the profile it is, X when left out.");
}

template <class Visitor>
void describe(Visitor& v, ResolutionSpec& s) {
  v.field("along", s.along, {.required = true, .identifier = true},
          "Name of the tool, which has a path and a contact with a face of the body.");
  v.field("half_width", s.halfWidth, {.required = true, .above = 0, .unit = "length"},
          "Half width of its contact, as far as it is known: the radius of a circle under a ball.");
  v.field(
      "spans_per_width", s.spansPerWidth, {.atLeast = 2, .atMost = 100},
      "Knot spans over the width of the contact, on all of the passes and a width beyond them. The first one into "
      "the depth is half as long.");
  v.field("growth", s.growth, {.above = 1, .atMost = 4},
          "Factor by which knot spans grow from one to the next, beyond the passes and into the depth.");
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
  v.field("resolution", s.resolution, {},
          "Of a box or a rectangle: knot spans that suit all passes of a tool on a path, instead of spans.");
  v.field(
      "relief", s.relief, {},
      "Roughness or waves on faces: at the anchors of the mesh (Greville abscissae, nodes) exact, inside fading "
      "out to the opposite face.");
}

template <class Visitor>
void describe(Visitor& v, PatchSpec& s) {
  v.field("name", s.name, {.required = true, .identifier = true},
          "Name for supports, loads, contact and measures; different for every patch.");
  v.alternatives("shape", s.shape, alternativesOf(s.shape), "Kind of patch.");
  describe(v, s.mesh);
}

template <class Visitor>
void describe(Visitor& v, PatchesSpec& s) {
  v.field("patches", s.patches, {.required = true, .minEntries = 1},
          "The patches; where faces of two of them have the same control points, they are joined.");
}

template <class Visitor>
void describe(Visitor& v, GeometrySpec& s) {
  v.alternatives("shape", s.shape, alternativesOf(s.shape), "Kind of body.");
  describe(v, s.mesh);
}

}  // namespace burnish::inline scene
