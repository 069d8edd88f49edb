#pragma once
#include <vector>

#include "engine/material/isochoric_point.h"
#include "engine/material/law_list.h"

namespace burnish::inline schema {
class Problems;
}  // namespace burnish::inline schema

namespace burnish::inline material {

/// W̄ = Σ μ_p/α_p (λ̄_1^α_p + λ̄_2^α_p + λ̄_3^α_p − 3).
struct Ogden {
  static constexpr LawKind kind{
      "ogden",
      "Rubber: sum of mu/alpha (l1^alpha + l2^alpha + l3^alpha - 3) in principal stretches, nearly incompressible. The initial "
      "shear modulus is half the sum of mu alpha. Programs that write 2 mu/alpha^2 have other mu: theirs times 2/alpha."};

  std::vector<double> mu;
  std::vector<double> alpha;  ///< one for each, none 0

  double shearModulus() const;
  IsochoricPoint at(const Eigen::Array3d& logStretches) const;
};

template <class Visitor>
void describe(Visitor& v, Ogden& s) {
  v.field("mu", s.mu,
          {.required = true, .minEntries = 1, .maxEntries = IsochoricPoint::kMostPowers, .unit = "stress"},
          "Factors mu.");
  v.field("alpha", s.alpha, {.required = true, .minEntries = 1, .maxEntries = IsochoricPoint::kMostPowers},
          "Exponents alpha, one for each factor.");
}

/// Reports what keeps the energy from being used.
void check(const Ogden& energy, const Problems& problems);

}  // namespace burnish::inline material
