#pragma once
#include "engine/schema/leaf.h"
#include "postproc/draw/contour/picture_options.h"
#include "postproc/probe/depth_numbers.h"
#include "postproc/probe/section_numbers.h"
#include "postproc/study/evidence/quantity.h"
#include "postproc/study/evidence/schema_reduction.h"

namespace burnish {

constexpr auto enumNames(std::type_identity<LineReduction>) {
  return std::array{std::pair{"variation", LineReduction::Variation}, std::pair{"max", LineReduction::Max},
                    std::pair{"min", LineReduction::Min}};
}

constexpr auto enumNames(std::type_identity<RoughnessMeasure::Number>) {
  return std::array{std::pair{"a", RoughnessMeasure::Number::A}, std::pair{"q", RoughnessMeasure::Number::Q},
                    std::pair{"z", RoughnessMeasure::Number::Z}};
}

/// A curve y(x) of a history: the same for charts and measures.
template <class Visitor>
void describeCurve(Visitor& v, std::string& x, std::string& y, std::string& where) {
  v.field("x", x, {}, "Column of history.csv, or a formula in its columns.");
  v.field("y", y, {.required = true}, "Column of history.csv, or a formula such as \"cylinder.fy/1000\".");
  v.field("where", where, {}, "Formula; rows in which it is 0 are left out, as in \"time >= 1\".");
}

/// The part of a curve that a measure looks at.
template <class Visitor>
void describeRange(Visitor& v, std::optional<std::array<double, 2>>& range) {
  v.field("range", range, {.increasing = true}, "Smallest and largest x; everything when left out.");
}

template <class Visitor>
void describe(Visitor& v, HistoryMeasure& s) {
  describeCurve(v, s.x, s.y, s.where);
  describeRange(v, s.range);
  v.field("reduce", s.reduce, {},
          "The number that is made of the curve; oscillation is the standard deviation about the "
          "least-squares quartic, at a value interpolated.");
  v.field("at", s.at, {}, "The x of `reduce: at`.");
}

template <class Visitor>
void describe(Visitor& v, SummaryMeasure& s) {
  v.field("entry", s.entry, {.required = true},
          "Key of summary.yaml, such as iterations, cut_backs or seconds.");
}

template <class Visitor>
void describe(Visitor& v, LineMeasure& s) {
  v.field("field", s.field, {.required = true, .choices = bodyFields()}, "Field that is sampled.");
  v.field("time", s.time, {.required = true, .atLeast = 0, .unit = "time"}, "Time of the frame.");
  v.field("height", s.height, {.atLeast = 0, .atMost = 1},
          "Where the line is: the second parameter of the first patch, as a part of its range.");
  v.field(
      "reduce", s.reduce, {},
      "The number that is made of the values along the line; variation is the sum of their |differences|.");
}

template <class Visitor>
void describe(Visitor& v, DifferenceMeasure& s) {
  v.field("other", s.other, {.required = true}, "Name of the run to compare with, braces filled in.");
  describeCurve(v, s.x, s.y, s.where);
  describeRange(v, s.range);
  v.field("tolerance", s.tolerance, {.above = 0},
          "Gives the first x at which the difference exceeds this part, instead of the largest difference.");
}

template <class Visitor>
void describe(Visitor&, ConvergenceMeasure&) {}

template <class Visitor>
void describeTime(Visitor& v, std::optional<double>& time) {
  v.field("time", time, {.atLeast = 0, .unit = "time"}, "Time of the frame; the end when left out.");
}

/// The place of a depth profile in a measure.
template <class Visitor>
void describeProfile(Visitor& v, ProbeSpec& s) {
  describeDepth(v, s, {.required = true});
  v.field("patch", s.patch, {}, "Patch of the face, in a body of several.");
  v.field("body", s.bodies, {}, "The body of the face, of several.");
}

template <class Visitor>
void describe(Visitor& v, DepthMeasure& s) {
  describeProfile(v, s.place);
  v.field("number", s.number, {.required = true, .choices = depthNumberNames()},
          "Which of the numbers of a depth profile.");
  describeTime(v, s.time);
}

template <class Visitor>
void describe(Visitor& v, SectionMeasure& s) {
  v.field("plane", s.plane, {.required = true},
          "Where the deformed bodies are cut: x=V, y=V or z=V, or X,Y,Z,NX,NY,NZ, a point and a normal.");
  v.field("body", s.bodies, {}, "Names of the bodies that are cut; all when left out.");
  v.field("number", s.number, {.required = true, .choices = sectionNumberNames()},
          "Which of the numbers of a section.");
  describeTime(v, s.time);
}

template <class Visitor>
void describe(Visitor& v, ProfileMeasure& s) {
  describeProfile(v, s.place);
  v.field("field", s.place.fields, {.required = true, .choices = profileFieldNames()},
          "One field, of the profile.");
  describePenetration(v, s.place);
  v.field("other", s.other, {.required = true}, "Name of the run to compare with, braces filled in.");
  v.field("range", s.range, {.increasing = true, .unit = "length"},
          "Smallest and largest depth that is compared; everything when left out.");
  describeTime(v, s.time);
}

template <class Visitor>
void describe(Visitor& v, RoughnessMeasure& s) {
  describe(v, s.face);
  v.field("number", s.number, {},
          "Which number: a, q or z, of Ra, Rq, Rz of a profile or Sa, Sq, Sz of an area.");
  describeTime(v, s.time);
}

template <class Visitor>
void describe(Visitor& v, MeasureSpec& s) {
  v.field("name", s.name, {.required = true, .identifier = true}, "Name, for claims.");
  v.field("title", s.title, {.required = true, .longest = kLongestShownText}, "Heading of its column.");
  v.alternatives(
      "kind", s.what,
      {{{"history", "A number of a curve of the history."},
        {"summary", "A number that the run says about itself at its end."},
        {"line", "A number of a field along a line through the body."},
        {"difference",
         "The largest |difference| of a curve from that of another run, as a part of the other's "
         "largest |y|."},
        {"convergence", "Median order of convergence of Newton's method over the steps."},
        {"depth", "A number of a depth profile: whether its section is in balance, what is left, how deep."},
        {"section",
         "A number of a plane section: the force and the moment that the stress over it makes, and whether it is in balance."},
        {"profile",
         "The largest |difference| of a depth profile from that of another run, as a part of the "
         "other's largest magnitude."},
        {"roughness", "Roughness of a face."}}},
      "Where the number comes from.");
}

}  // namespace burnish
