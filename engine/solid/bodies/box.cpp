#include "engine/solid/bodies/box.h"

#include "engine/nurbs/shapes.h"

namespace burnish::inline solid {

Patch<3> BoxBody::patch() const {
  return box(origin, size);
}

}  // namespace burnish::inline solid
