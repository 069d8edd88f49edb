#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>

#include "engine/material/isochoric_point.h"

namespace burnish::inline fit {

/// How a sheet of rubber is pulled.
enum class RubberTest {
  Uniaxial,     ///< along one direction, the others free
  Equibiaxial,  ///< along two directions alike
  Planar        ///< along one direction, a second one held ("pure shear")
};

inline constexpr std::array kRubberTests{RubberTest::Uniaxial, RubberTest::Equibiaxial, RubberTest::Planar};

inline const char* wordOf(RubberTest test) {
  constexpr std::array words{"uniaxial", "equibiaxial", "planar"};
  return words[static_cast<std::size_t>(test)];
}

/// Logarithms of the principal stretches of an incompressible body; the third direction is free.
inline Eigen::Array3d logStretches(RubberTest test, double stretch) {
  const double e = std::log(stretch);
  switch (test) {
    case RubberTest::Uniaxial:
      return {e, -0.5 * e, -0.5 * e};
    case RubberTest::Equibiaxial:
      return {e, e, -2.0 * e};
    default:
      return {e, 0.0, -e};
  }
}

/// Nominal stress (β_1 − β_3)/λ of an incompressible body at the stretch λ.
template <class Energy>
double nominalStress(const Energy& energy, RubberTest test, double stretch) {
  const Eigen::Array3d e = logStretches(test, stretch);
  const IsochoricPoint point = energy.at(e);
  double difference = 0.0;
  for (const auto& [mu, alpha] : point.powers())
    difference += mu * (std::exp(alpha * e[0]) - std::exp(alpha * e[2]));
  return difference / stretch;
}

}  // namespace burnish::inline fit
