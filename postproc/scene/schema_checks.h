#pragma once
#include "engine/schema/leaf.h"
#include "postproc/scene/scene_checks.h"
#include "postproc/study/evidence/schema_expectation.h"
#include "postproc/study/evidence/schema_reduction.h"

namespace burnish {

constexpr auto enumNames(std::type_identity<VariantsSpec::Sizes>) {
  return std::array{std::pair{"cells", VariantsSpec::Sizes::Cells},
                    std::pair{"steps", VariantsSpec::Sizes::Steps}};
}

constexpr auto enumNames(std::type_identity<CheckSpec::Meshes>) {
  return std::array{std::pair{"finest", CheckSpec::Meshes::Finest},
                    std::pair{"every", CheckSpec::Meshes::Every}};
}

template <class Visitor>
void describe(Visitor& v, FamilySpec& s) {
  v.field("name", s.name, {.required = true}, "Name of the family in tables and charts.");
  v.field("set", s.set, {}, "Changes of the scene, as `burnish run --set` takes them.");
}

template <class Visitor>
void describe(Visitor& v, MeshVariantSpec& s) {
  v.field("size", s.size, {.required = true, .above = 0}, "Size of a cell, or of a step, in any unit.");
  v.field("set", s.set, {}, "Changes of the scene, as `burnish run --set` takes them.");
}

template <class Visitor>
void describe(Visitor& v, VariantsSpec& s) {
  v.field("families", s.families, {}, "Kinds of discretisation; the scene as it is when left out.");
  v.field("meshes", s.meshes, {}, "Meshes from coarse to fine; the scene as it is when left out.");
  v.field("sizes", s.sizes, {}, "What the sizes of the meshes are sizes of: steps where only these change.");
}

template <class Visitor>
void describe(Visitor& v, CheckSpec& s) {
  v.field("name", s.name, {.required = true}, "What is checked, in words.");
  v.field("quantity", s.quantity.formula, {.required = true},
          "A column of the history or a formula in columns; definitions may be used.");
  v.field("reduction", s.quantity.reduction, {}, "Which of the rows counts.");
  v.field("time", s.quantity.time, {.atLeast = 0, .unit = "time"}, "The row of this time counts instead.");
  v.field("families", s.families, {}, "Families that are checked; all when left out.");
  v.field("meshes", s.meshes, {}, "Meshes on which a value or range is checked.");
  v.alternatives("expect", s.expect,
                 {{{"value", "The quantity is a value within a tolerance."},
                   {"range", "The quantity lies between bounds."},
                   {"order", "The quantity, an error, falls with an order of the size."},
                   {"monotone", "The quantity grows or falls from mesh to mesh."},
                   {"same", "The quantity is the same for all families."}}},
                 "What is expected.");
  v.field("source", s.source, {}, "Where the expectation comes from.");
}

template <class Visitor>
void describe(Visitor& v, CurveChartSpec& s) {
  v.field(
      "contact", s.contact, {},
      "Name of a tool or of a pair of faces: the curves then run along the face that touches, at the end of "
      "the run. Left out: over the history.");
  v.field(
      "x", s.x, {.required = true},
      "A column of the history or a formula in columns. With contact in those of the face's quadrature "
      "points: x, y, pressure, gap, and with friction friction_x and friction_y, the tangential traction on "
      "the body; definitions may be used.");
  v.field("y", s.y, {.required = true}, "The same along the y axis.");
  v.field("exact", s.exact, {}, "With contact: y of theory, drawn at the points of the last run.");
  v.field("x_title", s.xTitle, {.longest = kLongestShownText},
          "Title of the x axis; the formula when left out.");
  v.field("y_title", s.yTitle, {.longest = kLongestShownText}, "Title of the y axis.");
  v.field("x_range", s.xRange, {.increasing = true},
          "Smallest and largest x; all of the curves when left out.");
  v.field("y_range", s.yRange, {.increasing = true}, "Smallest and largest y.");
}

}  // namespace burnish
