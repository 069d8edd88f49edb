#pragma once
#include "engine/scene/scene.h"
#include "engine/scene/schema_boundary.h"
#include "engine/schema/leaf.h"

namespace burnish {

template <>
struct EnumNames<CheckSpec::Reduction> {
  static constexpr std::array values{std::pair{"last", CheckSpec::Reduction::Last},
                                     std::pair{"max", CheckSpec::Reduction::Max},
                                     std::pair{"min", CheckSpec::Reduction::Min}};
};

template <>
struct EnumNames<EllipseMeasureSpec::Middle> {
  static constexpr std::array values{std::pair{"free", EllipseMeasureSpec::Middle::Free},
                                     std::pair{"begin", EllipseMeasureSpec::Middle::Begin},
                                     std::pair{"end", EllipseMeasureSpec::Middle::End}};
};

template <>
struct EnumNames<CheckSpec::Meshes> {
  static constexpr std::array values{std::pair{"finest", CheckSpec::Meshes::Finest},
                                     std::pair{"every", CheckSpec::Meshes::Every}};
};

template <>
struct EnumNames<MonotoneCheckSpec::Direction> {
  static constexpr std::array values{std::pair{"increasing", MonotoneCheckSpec::Direction::Increasing},
                                     std::pair{"decreasing", MonotoneCheckSpec::Direction::Decreasing}};
};

/// Lists in one.
inline std::vector<std::string> joined(const std::vector<std::vector<std::string>>& lists) {
  std::vector<std::string> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

template <class Visitor>
void describe(Visitor& v, PointMeasureSpec& s) {
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
  v.field("displacement", s.displacement, {.required = true, .perDimension = true, .unit = "length"},
          "The exact displacement, formulas in X, Y, Z and t.");
}

template <class Visitor>
void describe(Visitor& v, EllipseMeasureSpec& s) {
  v.field("tool", s.tool, {.required = true}, "Name of a tool that may touch the face.");
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
  v.field("field", s.field, {.required = true, .choices = joined({materialScalarNames(), {"von_mises", "pressure"}})},
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
         "peak."},
        {"extent",
         "How far a face reaches now, over its quadrature points: NAME.xmin, NAME.xmax, NAME.ymin, ..."},
        {"percentile",
         "The value below which a field is in a share of the volume, over the quadrature points: NAME.value. "
         "It converges where a largest value does not."}}},
      "What is measured.");
}

template <class Visitor>
void describe(Visitor& v, FamilySpec& s) {
  v.field("name", s.name, {.required = true}, "Name of the family in tables and charts.");
  v.field("set", s.set, {}, "Changes of the scene, as `burnish run --set` takes them.");
}

template <class Visitor>
void describe(Visitor& v, MeshVariantSpec& s) {
  v.field("size", s.size, {.required = true, .above = 0}, "Size of a cell, in any unit.");
  v.field("set", s.set, {}, "Changes of the scene, as `burnish run --set` takes them.");
}

template <class Visitor>
void describe(Visitor& v, VariantsSpec& s) {
  v.field("families", s.families, {}, "Kinds of discretisation; the scene as it is when left out.");
  v.field("meshes", s.meshes, {}, "Meshes from coarse to fine; the scene as it is when left out.");
}

template <class Visitor>
void describe(Visitor& v, ValueCheckSpec& s) {
  v.field("value", s.value, {.required = true}, "A number, or a formula in the definitions.");
  v.field("relative", s.relative, {.above = 0}, "Largest deviation, relative to the value.");
  v.field("absolute", s.absolute, {.above = 0}, "Largest deviation; give either this or relative.");
}

template <class Visitor>
void describe(Visitor& v, RangeCheckSpec& s) {
  v.field("at_least", s.atLeast, {}, "Lower bound, a number or a formula in the definitions.");
  v.field("at_most", s.atMost, {}, "Upper bound.");
}

template <class Visitor>
void describe(Visitor& v, OrderCheckSpec& s) {
  v.field("order", s.order, {.required = true, .above = 0}, "Order that theory has.");
  v.field("tolerance", s.tolerance, {.above = 0, .below = 1},
          "The observed order, that of the two finest meshes, may be lower by so much.");
  v.field("limit", s.limit, {},
          "Exact value of the quantity, a number or a formula in the definitions; the quantity is an error "
          "itself when left out.");
  v.field("floor", s.floor, {.atLeast = 0}, "Meshes with a smaller error are left out.");
}

template <class Visitor>
void describe(Visitor& v, MonotoneCheckSpec& s) {
  v.field("direction", s.direction, {}, "From the coarse to the fine meshes.");
}

template <class Visitor>
void describe(Visitor& v, SameCheckSpec& s) {
  v.field("relative", s.relative, {.above = 0},
          "Largest difference between two families, relative to the largest value.");
}

template <class Visitor>
void describe(Visitor& v, CheckSpec& s) {
  v.field("name", s.name, {.required = true}, "What is checked, in words.");
  v.field("quantity", s.quantity, {.required = true},
          "A column of the history or a formula in columns; definitions may be used.");
  v.field("reduction", s.reduction, {}, "Which of the rows counts.");
  v.field("time", s.time, {.atLeast = 0, .unit = "time"}, "The row of this time counts instead.");
  v.field("families", s.families, {}, "Families that are checked; all when left out.");
  v.field("meshes", s.meshes, {}, "Meshes on which a value or range is checked.");
  v.alternatives("expect", s.expect,
                 {{{"value", "The quantity is a value within a tolerance."},
                   {"range", "The quantity lies between bounds."},
                   {"order", "The quantity, an error, falls with an order of the cell size."},
                   {"monotone", "The quantity grows or falls from mesh to mesh."},
                   {"same", "The quantity is the same for all families."}}},
                 "What is expected.");
  v.field("source", s.source, {}, "Where the expectation comes from.");
}

template <class Visitor>
void describe(Visitor& v, CurveChartSpec& s) {
  v.field("x", s.x, {.required = true}, "A column of the history or a formula in columns.");
  v.field("y", s.y, {.required = true}, "The same along the y axis.");
  v.field("x_title", s.xTitle, {.longest = kLongestShownText},
          "Title of the x axis; the formula when left out.");
  v.field("y_title", s.yTitle, {.longest = kLongestShownText}, "Title of the y axis.");
}

}  // namespace burnish
