#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/core/input_error.h"
#include "engine/schema/leaf.h"
#include "postproc/draw/contour/picture_options.h"
#include "postproc/probe/probe.h"

namespace burnish {

/// What is looked at, as the options of the command and studies spell it. Empty texts: not given.
struct ProbeSpec {
  std::string line, face, depth, point;  ///< one of them, or a line on a face
  std::optional<double> length, spot;    ///< of `depth`
  std::string patch;                     ///< of the face
  std::vector<std::string> bodies;       ///< all when empty
  std::vector<std::string> fields;       ///< what one most probably wants to see when empty
  std::string formula;                   ///< in the fields, drawn instead of them
  std::string formulaName = "formula";   ///< what it is called
  bool reference = false;                ///< the path lies in the undeformed body
  int points = kProbePoints;
  std::optional<double> window;
  std::optional<double> penetration;  ///< of X-rays
  double hardenedBelow = 0.002;       ///< plastic strain, of `DepthNumbers`
  bool mean = false;                  ///< of all of a path

  /// A point is looked at over time, and so is the mean of a path.
  bool isOverTime() const { return mean || !point.empty(); }

  bool operator==(const ProbeSpec&) const = default;
};

/// Where a depth profile begins, and how far it goes.
template <class Visitor>
void describeDepth(Visitor& v, ProbeSpec& s, const Rule& ofPlace) {
  v.field(
      "depth", s.depth, ofPlace,
      "FACE@S or FACE@X,Y, in space with Z: values along the inward normal of a face, from a length along "
      "it, or from the point of it that is nearest to a position.");
  v.field("length", s.length, {.above = 0, .unit = "length"},
          "How far depth goes; to where it leaves the body when left out.");
  v.field(
      "spot", s.spot, {.above = 0, .unit = "length"},
      "Means over this length along a face, in space over a square of this side, instead of values below one place: what a beam "
      "of that width sees at each depth.");
  v.field("hardened_below", s.hardenedBelow, {.above = 0},
          "Plastic strain below which metal does not count as hardened, in the numbers of a depth profile.");
}

/// How deep a depth profile's values see.
template <class Visitor>
void describePenetration(Visitor& v, ProbeSpec& s) {
  v.field(
      "penetration", s.penetration, {.above = 0, .unit = "length"},
      "What X-rays with this depth of penetration tell at each depth, once all above it has been taken away: "
      "means of what lies deeper with the weight exp(-depth/penetration).");
}

/// ofFields: rule of the names of fields.
template <class Visitor>
void describeProbe(Visitor& v, ProbeSpec& s, const Rule& ofFields) {
  v.field(
      "line", s.line, {},
      "X0,Y0:X1,Y1, in space with Z: values along the straight line between two points; with face along that line laid on "
      "the face.");
  v.field(
      "face", s.face, {},
      "Values along a face of a plane body: left, right, bottom or top; in space, also back or front, along a line on it.");
  describeDepth(v, s, {});
  v.field("point", s.point, {},
          "X,Y, in space with Z: values over time at a point of the material, by its place in the undeformed "
          "body.");
  v.field("patch", s.patch, {}, "Patch of the face, in a body of several.");
  v.field("body", s.bodies, {}, "Names of the bodies that are looked at; all when left out.");
  v.field(
      "field", s.fields, ofFields,
      "What is drawn, one field or several of one unit; displacement alone is its magnitude; plastic_strain "
      "or von_mises when left out; fields of contact along faces; stress.along, stress.across and stress.normal in the axes "
      "of a face.");
  v.field("formula", s.formula, {},
          "Formula in the fields named by field, drawn instead of them, such as a hardness that follows from "
          "plastic_strain; components are spelled stress_xx.");
  v.field("formula_name", s.formulaName, {.longest = kLongestShownText},
          "What the formula is called in charts and tables, such as Hardness [MPa].");
  v.field("reference", s.reference, {},
          "The path lies in the undeformed body and is measured there, not in the deformed one.");
  v.field("points", s.points, {.atLeast = 2, .atMost = 1e6},
          "Points at equal distances; those where the path leaves a body are added.");
  v.field(
      "window", s.window, {.above = 0, .unit = "length"},
      "Mean values of a window of this width along the path instead of values at points; of a point the mean over the disc, "
      "in space the ball, of this diameter about it in the undeformed body.");
  describePenetration(v, s);
  v.field("mean", s.mean, {}, "The mean of all of the path over time instead of values along it.");
}

/// Fields that a depth profile of a run may show: of bodies, and stresses in the axes of a surface.
std::vector<std::string> profileFieldNames();

/// These, and those of contact.
std::vector<std::string> probedFieldNames();

template <class Visitor>
void describe(Visitor& v, ProbeSpec& s) {
  describeProbe(v, s, {.choices = probedFieldNames()});
}

/// Of files of any program, whose fields have any name.
struct AnyProbeSpec : ProbeSpec {};

template <class Visitor>
void describe(Visitor& v, AnyProbeSpec& s) {
  describeProbe(v, s, {});
}

/// The fields as formulas call them: stress_xx.
std::vector<std::string> formulaVariables(const std::vector<std::string>& fields);

/// What keys say that cannot be, each alone or two together, by the key.
std::vector<InputProblem> conflictsIn(const ProbeSpec& spec);

}  // namespace burnish
