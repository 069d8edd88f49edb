#include "engine/solid/bodies/ellipse.h"

#include "engine/nurbs/shapes.h"

namespace burnish::inline solid {

Patch<2> EllipseBody::patch() const {
  return ellipse(center.head<2>(), size.head<2>());
}

}  // namespace burnish::inline solid
