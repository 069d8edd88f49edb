#pragma once
#include "engine/schema/leaf.h"
#include "postproc/study/evidence/expectation.h"

namespace burnish {

constexpr auto enumNames(std::type_identity<ExpectedTrend::Direction>) {
  return std::array{std::pair{"increasing", ExpectedTrend::Direction::Increasing},
                    std::pair{"decreasing", ExpectedTrend::Direction::Decreasing}};
}

template <class Visitor>
void describe(Visitor& v, ExpectedValue& s) {
  v.field("value", s.value, {.required = true}, "A number, or a formula in the definitions.");
  v.field("relative", s.relative, {.above = 0}, "Largest deviation, relative to the value.");
  v.field("absolute", s.absolute, {.above = 0}, "Largest deviation; give either this or relative.");
}

template <class Visitor>
void describe(Visitor& v, ExpectedRange& s) {
  v.field("at_least", s.atLeast, {}, "Lower bound, a number or a formula in the definitions.");
  v.field("at_most", s.atMost, {}, "Upper bound.");
}

template <class Visitor>
void describe(Visitor& v, ExpectedOrder& s) {
  v.field("order", s.order, {.required = true, .above = 0}, "Order that theory has.");
  v.field("tolerance", s.tolerance, {.above = 0, .below = 1},
          "The observed order, that of the two finest meshes, may be lower by so much.");
  v.field("limit", s.limit, {},
          "Exact value of the quantity, a number or a formula in the definitions; the quantity is an error "
          "itself when left out.");
  v.field("floor", s.floor, {.atLeast = 0}, "Meshes with a smaller error are left out.");
}

template <class Visitor>
void describe(Visitor& v, ExpectedTrend& s) {
  v.field("direction", s.direction, {}, "From the coarse to the fine meshes.");
}

template <class Visitor>
void describe(Visitor& v, ExpectedSameness& s) {
  v.field("relative", s.relative, {.above = 0},
          "Largest difference between two families, relative to the largest value.");
}

}  // namespace burnish
