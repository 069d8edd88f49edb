#pragma once
#include "engine/scene/scene.h"
#include "engine/scene/schema_tools.h"
#include "engine/schema/leaf.h"

namespace burnish::inline scene {

inline std::vector<std::string> faceNames() {
  return {"left", "right", "bottom", "top", "back", "front"};
}

inline constexpr const char* kBodySentence = "Name of the body; to be left out if there is only one.";
inline constexpr const char* kPatchSentence = "Name of the patch; to be left out if there is only one.";
inline constexpr const char* kFaceSentence =
    "Face of the patch: left and right end the first direction, bottom and top the second, back and front "
    "the third.";

inline constexpr const char* kPartSentence =
    "Begin and end of a part of the face, in parameters from 0 to 1, two numbers per direction of the face.";

/// A whole face.
template <class Visitor>
void describeFace(Visitor& v, FaceSpec& s) {
  v.field("body", s.body, {.identifier = true}, kBodySentence);
  v.field("patch", s.patch, {.identifier = true}, kPatchSentence);
  v.field("face", s.face, {.required = true, .choices = faceNames()}, kFaceSentence);
}

template <class Visitor>
void describePart(Visitor& v, FaceSpec& s, const char* sentence = kPartSentence) {
  v.field("part", s.part, {.atLeast = 0, .atMost = 1, .minEntries = 2, .maxEntries = 4}, sentence);
  v.field(
      "length", s.length, {.atLeast = 0, .minEntries = 2, .maxEntries = 2, .unit = "length"},
      "The same in lengths along the undeformed face from its beginning, instead of part (two dimensions).");
}

template <class Visitor>
void describe(Visitor& v, PrescribedSpec& s) {
  v.field("x", s.x, {.unit = "length"}, "Displacement in x.");
  v.field("y", s.y, {.unit = "length"}, "Displacement in y.");
  v.field("z", s.z, {.unit = "length"}, "Displacement in z (3D).");
}

template <class Visitor>
void describe(Visitor& v, SupportSpec& s) {
  v.field("name", s.name, {.identifier = true},
          "Name under which results list the force of the body on it; support1, support2, ... by its place "
          "in the list when left out.");
  describeFace(v, s.place);
  describePart(v, s.place,
               "Begin and end of a part of the face, in parameters from 0 to 1, two numbers per direction of "
               "the face; it holds the control points whose Greville abscissae (nodes of a Lagrange basis) "
               "lie in it. Begin and end alike name a point: that of the control point nearest to it, such "
               "as [0, 0], the corner at the beginning.");
  v.field("fix", s.fix, {.minEntries = 1, .choices = {"x", "y", "z"}},
          "Displacement components that are held.");
  v.field("move", s.move, {}, "Displacement components that follow a schedule; those left out are free.");
  v.field("prescribe", s.prescribe, {},
          "Displacement components that follow formulas in X, Y, Z and t; those left out are free.");
  v.field(
      "symmetry", s.symmetry, {},
      "Plane of symmetry: holds the component normal to the face, which is flat and aligned with an axis.");
  v.field("until", s.until, {.above = 0, .unit = "time"},
          "Time at which it lets go; to the end when left out. From then on its force goes linearly to zero, "
          "step by step in balance, and the other supports hold what is left.");
  v.field("released_by", s.releasedBy, {.above = 0, .unit = "time"},
          "Time at which the force of a support that lets go is zero; the end of the run when left out.");
}

template <class Visitor>
void describe(Visitor& v, LoadSpec& s) {
  v.field("body", s.place.body, {.identifier = true}, kBodySentence);
  v.field("patch", s.place.patch, {.identifier = true}, kPatchSentence);
  v.field("face", s.place.face, {.choices = faceNames()}, kFaceSentence);
  describePart(v, s.place);
  v.field("traction", s.traction, {.perDimension = true, .unit = "stress"},
          "Force per area of the undeformed face, which stays what it is while the face moves; in X, Y, Z "
          "and t.");
  v.field("pressure", s.pressure, {.unit = "stress"},
          "Force per area of the deformed face, against its normal, which it follows.");
  v.field(
      "shear", s.shear, {.unit = "stress"},
      "Force per area of the deformed face along it, in the direction of its parameter (two dimensions).");
  v.field("body_force", s.bodyForce, {.perDimension = true, .unit = "stress per length"},
          "Force per undeformed volume, on all patches of the body or the named one; needs no face.");
  v.field("schedule", s.schedule, {}, "Factor over time; 1 when left out.");
}

template <class Visitor>
void describe(Visitor& v, FaceSpec& s) {
  describeFace(v, s);
}

template <class Visitor>
void describe(Visitor& v, ContactSpec& s) {
  v.field("tool", s.tool, {}, "Name of a tool; or against.");
  describeFace(v, s.place);
  v.field("against", s.against, {},
          "The face of a body that this one may touch, instead of a tool, or a list of faces, which are one "
          "surface: it goes on where they have an edge in common. The face that is named first carries "
          "quadrature and multipliers: it should be the finer one, and not hang over the other.");
  v.field(
      "name", s.name, {.identifier = true},
      "Name of a pair of faces in results; the names of its two bodies, as in punch-block, when left out.");
  v.field(
      "reach", s.reach, {.above = 0, .unit = "length"},
      "Faces that are farther apart do not see each other; a twentieth of the smaller body's largest "
      "extent when left out. Steps in which a face would go through another one unseen are made smaller.");
  v.field("interference", s.interference, {},
          "What is done about faces of a pair that overlap at the start: it is an error, or the bodies are "
          "fitted into one another during the first phase, without friction (shrink fit).");
  v.field("segments", s.segments, {},
          "Quadrature of a pair is split where the other face has knots and where it ends, so that forces on "
          "both faces are integrated alike; of bodies in the plane, not with pointwise-penalty.");
  describe(v, s.options);
}

template <class Visitor>
void describe(Visitor& v, SelfContactSpec& s) {
  v.field("body", s.place.body, {.identifier = true}, kBodySentence);
  v.field("patch", s.place.patch, {.identifier = true}, kPatchSentence);
  v.field("face", s.place.face, {.choices = faceNames()}, kFaceSentence);
  v.field(
      "faces", s.faces, {.minEntries = 1, .choices = faceNames()},
      "Several faces of the patch instead of face: they are one surface, whose parts may touch one another.");
  v.field("reach", s.reach, {.above = 0, .unit = "length"},
          "Parts of the face that look at each other from nearer than this are kept apart; a twentieth of "
          "the body's largest extent when left out.");
  v.field("method", s.options.method, {},
          "As under contact: mortar augmented Lagrangian, the integral one with contact or none at every "
          "quadrature point, mortar penalty, or penalty at every quadrature point.");
  v.field(
      "parameter", s.options.parameter, {.above = 0, .unit = "stress per length"},
      "Penalty or augmentation parameter; when left out E/L (mortar), E/d (integral) or 100 E/L (penalties), "
      "L the body's largest extent, d the mean distance of control points on the face.");
  v.field("quadrature_points", s.options.quadraturePoints, {.atLeast = 1, .atMost = 32},
          "Quadrature points per knot span and direction; twice the degree when left out.");
  v.field(
      "gap_limit", s.options.gapLimit, {.above = 0, .atMost = 1},
      "As under contact: only up to this share of the knot span's length do gaps count in full in averages. "
      "For a part that meets another one with an edge: 0.02. All gaps count in full when left out.");
  describeFriction(v, s.options);
}

}  // namespace burnish::inline scene
