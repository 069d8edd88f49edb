#pragma once
#include <array>
#include <utility>

#include "engine/core/enum_names.h"

namespace burnish {

enum class LengthUnit { Micrometre, Millimetre, Centimetre, Metre, Inch, Foot };

template <>
struct EnumNames<LengthUnit> {
  static constexpr std::array values{
      std::pair{"um", LengthUnit::Micrometre}, std::pair{"mm", LengthUnit::Millimetre},
      std::pair{"cm", LengthUnit::Centimetre}, std::pair{"m", LengthUnit::Metre},
      std::pair{"in", LengthUnit::Inch},       std::pair{"ft", LengthUnit::Foot}};
};

}  // namespace burnish
