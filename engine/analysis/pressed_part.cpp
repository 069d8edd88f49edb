#include "engine/analysis/pressed_part.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace burnish::inline analysis {

template <int Dim>
PressedPart pressedPart(const FaceContact<Dim>& contact) {
  PressedPart part;
  for (const auto& span : contact.face().spans()) {
    const auto pressure = contact.state().pressure.segment(span.firstPoint, span.weights.size());
    const double area = (pressure.array() > 0.0).select(span.weights.array(), 0.0).sum();
    part.area += area;
    if (area > 0.0) part.largestSpan = std::max(part.largestSpan, span.size);
  }
  return part;
}

template <int Dim>
double halfWidthOf(double area) {
  return Dim == 2 ? 0.5 * area : std::sqrt(area / std::numbers::pi);
}

template PressedPart pressedPart(const FaceContact<2>&);
template PressedPart pressedPart(const FaceContact<3>&);
template double halfWidthOf<2>(double);
template double halfWidthOf<3>(double);

}  // namespace burnish::inline analysis
