#pragma once
#include <array>
#include <utility>

#include "engine/core/enum_names.h"

namespace burnish::inline core {

enum class LengthUnit { Nanometre, Micrometre, Millimetre, Centimetre, Metre, Inch, Foot };

constexpr auto enumNames(std::type_identity<LengthUnit>) {
  return std::array{std::pair{"nm", LengthUnit::Nanometre},  std::pair{"um", LengthUnit::Micrometre},
                    std::pair{"mm", LengthUnit::Millimetre}, std::pair{"cm", LengthUnit::Centimetre},
                    std::pair{"m", LengthUnit::Metre},       std::pair{"in", LengthUnit::Inch},
                    std::pair{"ft", LengthUnit::Foot}};
}

constexpr double millimetresOf(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::Nanometre:
      return 1e-6;
    case LengthUnit::Micrometre:
      return 1e-3;
    case LengthUnit::Millimetre:
      return 1.0;
    case LengthUnit::Centimetre:
      return 10.0;
    case LengthUnit::Metre:
      return 1000.0;
    case LengthUnit::Inch:
      return 25.4;
    case LengthUnit::Foot:
      return 304.8;
  }
  return 1.0;
}

}  // namespace burnish::inline core
