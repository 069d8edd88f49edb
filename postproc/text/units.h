#pragma once
#include <string>

#include "engine/results/result.h"

namespace burnish {

/// Units of what follows from a stress and lengths, by their usual names where there are any: a force is N
/// where stresses are MPa and lengths mm, per unit of depth N/mm; else MPa·in², MPa·in. All are empty for a
/// model without units.
struct DerivedUnits {
  std::string length;
  std::string area;    ///< of contact; a length per unit of depth
  std::string force;   ///< per unit of depth in plane strain, of the whole ring in axisymmetry
  std::string energy;  ///< as forces; also of moments
};

DerivedUnits derivedUnits(const ModelRecord& model);

/// "TITLE [UNIT]", or the title alone without a unit.
std::string withUnit(const std::string& title, const std::string& unit);

}  // namespace burnish
