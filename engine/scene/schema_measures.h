#pragma once
#include <string>
#include <vector>

#include "engine/material/material.h"
#include "engine/scene/scene.h"
#include "engine/scene/schema_boundary.h"
#include "engine/schema/leaf.h"

namespace burnish::inline scene {

constexpr auto enumNames(std::type_identity<EllipseMeasureSpec::Middle>) {
  return std::array{std::pair{"free", EllipseMeasureSpec::Middle::Free},
                    std::pair{"begin", EllipseMeasureSpec::Middle::Begin},
                    std::pair{"end", EllipseMeasureSpec::Middle::End}};
}

/// Lists in one.
inline std::vector<std::string> joined(const std::vector<std::vector<std::string>>& lists) {
  std::vector<std::string> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

template <class Visitor>
void describe(Visitor& v, PointMeasureSpec& s) {
  v.field("body", s.body, {.identifier = true}, kBodySentence);
  v.field("patch", s.patch, {.identifier = true}, kPatchSentence);
  v.field("parameters", s.parameters, {.atLeast = 0, .atMost = 1, .perDimension = true},
          "Place of the point in the patch, from 0 to 1 in each direction; give either this or position.");
  v.field("position", s.position, {.perDimension = true, .unit = "length"},
          "Place of the point in the undeformed body.");
  v.field("fields", s.fields,
          {.choices = joined({{"displacement"}, materialFieldNames(), {"von_mises", "pressure", "stress"}})},
          "What is measured; displacement alone when left out.");
}

template <class Visitor>
void describe(Visitor& v, FaceMeasureSpec& s) {
  describeFace(v, s.place);
  describePart(v, s.place);
}

template <class Visitor>
void describe(Visitor& v, ErrorMeasureSpec& s) {
  v.field("body", s.body, {.identifier = true}, kBodySentence);
  v.field("displacement", s.displacement, {.required = true, .perDimension = true, .unit = "length"},
          "The exact displacement, formulas in X, Y, Z and t.");
}

template <class Visitor>
void describe(Visitor& v, EllipseMeasureSpec& s) {
  v.field("tool", s.tool, {.required = true},
          "Name of a tool that may touch the face, or of a pair of faces whose first one it is.");
  describeFace(v, s.place);
  v.field("middle", s.middle, {},
          "Where the middle is: found by the fit, or at the begin or end of the face because that is a plane "
          "of symmetry.");
}

template <class Visitor>
void describe(Visitor& v, ExtentMeasureSpec& s) {
  describeFace(v, s.place);
}

template <class Visitor>
void describe(Visitor& v, PercentileMeasureSpec& s) {
  v.field("body", s.body, {.identifier = true}, kBodySentence);
  v.field("field", s.field,
          {.required = true, .choices = joined({materialScalarNames(), {"von_mises", "pressure"}})},
          "Field at the quadrature points.");
  v.field("share", s.share, {.above = 0, .below = 1}, "Of the undeformed volume.");
}

template <class Visitor>
void describe(Visitor& v, SceneMeasureSpec& s) {
  v.field("name", s.name, {.required = true, .identifier = true},
          "Beginning of the columns' names; different for every measure and tool.");
  v.alternatives(
      "kind", s.kind,
      {{{"point", "Displacement and projected fields at a material point: NAME.ux, NAME.stress_xx, ..."},
        {"face",
         "Mean displacement of a face by undeformed area, and the force that its supports, tools and loads "
         "apply to the body, summed over its control points: NAME.ux, NAME.fx, ..."},
        {"error",
         "Errors against an exact displacement, relative to its norm: NAME.L2, and NAME.H1 of the gradient."},
        {"ellipse",
         "The half ellipse that fits the contact pressure best, as p^2 over the square of the distance from "
         "its middle: NAME.peak, NAME.half_width, NAME.middle, and NAME.deviation, the largest one over the "
         "peak. With friction NAME.stick_peak, ... of what the tangential traction lacks of its limit, which is "
         "a half ellipse too where a contact of Hertz's kind sticks partly."},
        {"extent",
         "How far a face reaches now, over its quadrature points: NAME.xmin, NAME.xmax, NAME.ymin, ..."},
        {"percentile",
         "The value below which a field is in a share of the volume, over the quadrature points: NAME.value. "
         "It converges where a largest value does not."}}},
      "What is measured.");
}

}  // namespace burnish::inline scene
