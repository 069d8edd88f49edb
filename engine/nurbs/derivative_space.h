#pragma once
#include <utility>
#include <vector>

#include "engine/nurbs/patch.h"

namespace burnish::inline nurbs {

/// The splines that span the derivatives of a basis in each direction.
template <int P>
TensorBasis<P> derivativeSpace(const TensorBasis<P>& basis) {
  std::vector<UnivariateBasis> directions;
  for (int d = 0; d < P; ++d) directions.push_back(basis.direction(d).derivativeSpace());
  return TensorBasis<P>(std::move(directions));
}

}  // namespace burnish::inline nurbs
