#pragma once
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/core/length_unit.h"

namespace burnish::inline core {

/// What is allowed for the label of a unit of length that lengths are converted from or into, for messages.
inline constexpr const char* kLengthLabels =
    "nm, um (µm, micron), mm, cm, m, in (inch) or ft (foot), or the name in full, such as millimetre";

/// Spellings of units of length beside those of `kNamesOf`. µ has two code points; capitals as IGES files have them.
inline constexpr std::array kOtherLengthLabels{
    std::pair<std::string_view, LengthUnit>{"nanometre", LengthUnit::Nanometre},
    std::pair<std::string_view, LengthUnit>{"nanometer", LengthUnit::Nanometre},
    std::pair<std::string_view, LengthUnit>{"\u00b5m", LengthUnit::Micrometre},
    std::pair<std::string_view, LengthUnit>{"\u03bcm", LengthUnit::Micrometre},
    std::pair<std::string_view, LengthUnit>{"micron", LengthUnit::Micrometre},
    std::pair<std::string_view, LengthUnit>{"microns", LengthUnit::Micrometre},
    std::pair<std::string_view, LengthUnit>{"micrometre", LengthUnit::Micrometre},
    std::pair<std::string_view, LengthUnit>{"micrometer", LengthUnit::Micrometre},
    std::pair<std::string_view, LengthUnit>{"UM", LengthUnit::Micrometre},
    std::pair<std::string_view, LengthUnit>{"millimetre", LengthUnit::Millimetre},
    std::pair<std::string_view, LengthUnit>{"millimeter", LengthUnit::Millimetre},
    std::pair<std::string_view, LengthUnit>{"MM", LengthUnit::Millimetre},
    std::pair<std::string_view, LengthUnit>{"centimetre", LengthUnit::Centimetre},
    std::pair<std::string_view, LengthUnit>{"centimeter", LengthUnit::Centimetre},
    std::pair<std::string_view, LengthUnit>{"CM", LengthUnit::Centimetre},
    std::pair<std::string_view, LengthUnit>{"metre", LengthUnit::Metre},
    std::pair<std::string_view, LengthUnit>{"meter", LengthUnit::Metre},
    std::pair<std::string_view, LengthUnit>{"M", LengthUnit::Metre},
    std::pair<std::string_view, LengthUnit>{"inch", LengthUnit::Inch},
    std::pair<std::string_view, LengthUnit>{"inches", LengthUnit::Inch},
    std::pair<std::string_view, LengthUnit>{"IN", LengthUnit::Inch},
    std::pair<std::string_view, LengthUnit>{"INCH", LengthUnit::Inch},
    std::pair<std::string_view, LengthUnit>{"foot", LengthUnit::Foot},
    std::pair<std::string_view, LengthUnit>{"feet", LengthUnit::Foot},
    std::pair<std::string_view, LengthUnit>{"FT", LengthUnit::Foot}};

/// The unit that a label of lengths names, such as "mm" or "inch"; nothing for one that is not known.
inline std::optional<LengthUnit> lengthUnitOf(std::string_view label) {
  for (const auto& [name, unit] : kNamesOf<LengthUnit>)
    if (label == name) return unit;
  for (const auto& [name, unit] : kOtherLengthLabels)
    if (label == name) return unit;
  return std::nullopt;
}

/// "mm" for millimetres, as scenes name them.
constexpr const char* labelOf(LengthUnit wanted) {
  const char* label = "";
  for (const auto& [name, unit] : kNamesOf<LengthUnit>)
    if (unit == wanted) label = name;
  return label;
}

}  // namespace burnish::inline core
