#pragma once
#include "engine/schema/leaf.h"
#include "postproc/scene/scene_checks.h"

namespace burnish {

template <>
struct EnumNames<CheckSpec::Reduction> {
  static constexpr std::array values{std::pair{"last", CheckSpec::Reduction::Last},
                                     std::pair{"max", CheckSpec::Reduction::Max},
                                     std::pair{"min", CheckSpec::Reduction::Min}};
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
