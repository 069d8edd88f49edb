#pragma once
#include "engine/material/isochoric_point.h"
#include "engine/material/law_list.h"

namespace burnish::inline material {

/// W̄ = C10 (Ī_1 − 3) + C01 (Ī_2 − 3).
struct MooneyRivlin {
  static constexpr LawKind kind{
      "mooney-rivlin",
      "Rubber: C10 (I1 - 3) + C01 (I2 - 3), nearly incompressible. The initial shear modulus is 2 (C10 + C01)."};

  double C10 = 0.0;
  double C01 = 0.0;

  double shearModulus() const { return 2.0 * (C10 + C01); }

  IsochoricPoint at(const Eigen::Array3d& logStretches) const {
    IsochoricPoint point;
    point.energy = C10 * powerSum(logStretches, 2.0) + C01 * powerSum(logStretches, -2.0);
    point.add(2.0 * C10, 2.0);
    point.add(-2.0 * C01, -2.0);
    return point;
  }
};

template <class Visitor>
void describe(Visitor& v, MooneyRivlin& s) {
  v.field("C10", s.C10, {.required = true, .unit = "stress"}, "Constant of the first invariant.");
  v.field("C01", s.C01, {.required = true, .unit = "stress"}, "Constant of the second invariant.");
}

}  // namespace burnish::inline material
