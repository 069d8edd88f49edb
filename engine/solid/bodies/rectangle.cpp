#include "engine/solid/bodies/rectangle.h"

#include "engine/nurbs/shapes.h"

namespace burnish {

Patch<2> RectangleBody::patch() const {
  return rectangle(origin.head<2>(), size.head<2>());
}

}  // namespace burnish
