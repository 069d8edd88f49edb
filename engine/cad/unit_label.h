#pragma once
#include <optional>
#include <string_view>

#include "engine/cad/length_unit.h"

namespace burnish {

/// The unit that a scene's label of lengths names, such as "mm"; nothing for one that no CAD file knows.
inline std::optional<LengthUnit> lengthUnitOf(std::string_view label) {
  for (const auto& [name, unit] : EnumNames<LengthUnit>::values)
    if (label == name) return unit;
  return std::nullopt;
}

}  // namespace burnish
