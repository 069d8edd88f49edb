#include "engine/solid/bodies/rectangle.h"

#include "engine/nurbs/shapes.h"

namespace burnish::inline solid {

Patch<2> RectangleBody::patch() const {
  return rectangle(origin.head<2>(), size.head<2>());
}

}  // namespace burnish::inline solid
