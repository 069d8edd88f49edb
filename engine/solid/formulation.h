#pragma once
#include <array>
#include <utility>

#include "engine/core/enum_names.h"

namespace burnish {

/// How the volume change of a body follows from its displacements.
enum class Formulation {
  Displacement,        ///< J = det F; locks when the law is nearly incompressible
  ProjectedDilatation  ///< J projected onto splines of one degree less (F-bar)
};

template <>
struct EnumNames<Formulation> {
  static constexpr std::array values{std::pair{"displacement", Formulation::Displacement},
                                     std::pair{"fbar", Formulation::ProjectedDilatation}};
};

}  // namespace burnish
