#include "postproc/text/units.h"

#include <array>

#include "postproc/text/ticks.h"

namespace burnish {
namespace {

/// What a stress times the square of a length is called.
struct NamedForce {
  const char *stress, *length, *force;
};

constexpr std::array kNamedForces{
    NamedForce{"Pa", "m", "N"},    NamedForce{"kPa", "m", "kN"},  NamedForce{"MPa", "m", "MN"},
    NamedForce{"GPa", "m", "GN"},  NamedForce{"kPa", "mm", "mN"}, NamedForce{"MPa", "mm", "N"},
    NamedForce{"GPa", "mm", "kN"}, NamedForce{"MPa", "µm", "µN"}, NamedForce{"MPa", "um", "µN"},
    NamedForce{"GPa", "µm", "mN"}, NamedForce{"GPa", "um", "mN"}, NamedForce{"psi", "in", "lbf"},
    NamedForce{"ksi", "in", "kip"}};

std::string power(const std::string& unit, int exponent) {
  return exponent == 1 ? unit : unit + superscript(exponent);
}

}  // namespace

DerivedUnits derivedUnits(const ModelRecord& model) {
  const std::string &stress = model.stressUnit, &length = model.lengthUnit;
  const bool perDepth = model.dim == 2 && !isAxisymmetric(model);
  DerivedUnits units{length, {}, {}, {}};
  if (length.empty()) return units;
  units.area = power(length, perDepth ? 1 : 2);
  if (stress.empty()) return units;
  units.force = stress + "·" + power(length, perDepth ? 1 : 2);
  units.energy = stress + "·" + power(length, perDepth ? 2 : 3);
  for (const NamedForce& named : kNamedForces) {
    if (stress != named.stress || length != named.length) continue;
    const std::string depth = perDepth ? "/" + length : "";
    units.force = named.force + depth;
    units.energy = std::string(named.force) + "·" + length + depth;
  }
  return units;
}

std::string withUnit(const std::string& title, const std::string& unit) {
  return unit.empty() ? title : title + " [" + unit + "]";
}

}  // namespace burnish
