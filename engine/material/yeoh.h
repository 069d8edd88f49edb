#pragma once
#include "engine/material/isochoric_point.h"
#include "engine/material/law_list.h"

namespace burnish::inline material {

/// W̄ = C10 (Ī_1 − 3) + C20 (Ī_1 − 3)² + C30 (Ī_1 − 3)³.
struct Yeoh {
  static constexpr LawKind kind{
      "yeoh",
      "Rubber: C10 (I1 - 3) + C20 (I1 - 3)^2 + C30 (I1 - 3)^3, nearly incompressible. The initial shear modulus is 2 C10."};

  double C10 = 0.0;
  double C20 = 0.0;
  double C30 = 0.0;

  double shearModulus() const { return 2.0 * C10; }

  IsochoricPoint at(const Eigen::Array3d& logStretches) const {
    const double i = powerSum(logStretches, 2.0);  // Ī_1 − 3
    IsochoricPoint point;
    point.energy = i * (C10 + i * (C20 + i * C30));
    point.add(2.0 * (C10 + i * (2.0 * C20 + i * 3.0 * C30)), 2.0);
    point.coupling = 4.0 * (2.0 * C20 + 6.0 * i * C30);
    return point;
  }
};

template <class Visitor>
void describe(Visitor& v, Yeoh& s) {
  v.field("C10", s.C10, {.required = true, .above = 0, .unit = "stress"}, "First constant.");
  v.field("C20", s.C20, {.unit = "stress"}, "Second constant, mostly negative.");
  v.field("C30", s.C30, {.unit = "stress"}, "Third constant.");
}

}  // namespace burnish::inline material
