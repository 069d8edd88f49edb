#include "engine/material/elastic_moduli.h"

#include <cmath>
#include <string>

#include "engine/core/error.h"

namespace burnish::inline material {

ElasticModuli::ElasticModuli(double youngsModulus, double poissonsRatio)
    : E(youngsModulus),
      lambda(youngsModulus * poissonsRatio / ((1.0 + poissonsRatio) * (1.0 - 2.0 * poissonsRatio))),
      mu(youngsModulus / (2.0 * (1.0 + poissonsRatio))),
      kappa(youngsModulus / (3.0 * (1.0 - 2.0 * poissonsRatio))) {
  if (!(youngsModulus > 0.0) || !std::isfinite(youngsModulus))
    throw Error("material: Young's modulus is " + std::to_string(youngsModulus) + ", it must be positive");
  if (!(poissonsRatio > -1.0 && poissonsRatio < 0.5))
    throw Error("material: Poisson's ratio is " + std::to_string(poissonsRatio) +
                ", it must lie between -1 and 0.5 (both excluded)");
}

}  // namespace burnish::inline material
