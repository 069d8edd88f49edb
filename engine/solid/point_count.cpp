#include "engine/solid/point_count.h"

namespace burnish::inline solid {
namespace {

int fewestPoints(const UnivariateBasis& basis) {
  const bool isSmooth = basis.numFunctions() == basis.numSpans() + basis.degree();
  return isSmooth && basis.degree() > 1 && basis.numSpans() > 1 ? basis.degree() : basis.degree() + 1;
}

}  // namespace

template <int Dim>
bool isHeldBy(int pointsPerDirection, const Body<Dim>& body) {
  for (const Patch<Dim>& patch : body.patches)
    for (int d = 0; d < Dim; ++d)
      if (pointsPerDirection < fewestPoints(patch.basis().direction(d))) return false;
  return true;
}

template bool isHeldBy(int, const Body<2>&);
template bool isHeldBy(int, const Body<3>&);

}  // namespace burnish::inline solid
