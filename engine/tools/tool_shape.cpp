#include "engine/tools/tool_shape.h"

namespace burnish::inline tools {

ShapeFile fileOf(const std::string& shape) {
  for (const ShapeKind& kind : kindsOf(SimpleShape()))
    if (shape == kind.key) return kind.file;
  return ShapeFile::None;
}

}  // namespace burnish::inline tools
