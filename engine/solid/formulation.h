#pragma once
#include <array>
#include <utility>

#include "engine/core/enum_names.h"

namespace burnish::inline solid {

/// How the volume change of a body follows from its displacements.
enum class Formulation {
  Displacement,        ///< J = det F; locks when the law is nearly incompressible
  ProjectedDilatation  ///< J projected onto splines of one degree less (F-bar)
};

constexpr auto enumNames(std::type_identity<Formulation>) {
  return std::array{std::pair{"displacement", Formulation::Displacement},
                    std::pair{"fbar", Formulation::ProjectedDilatation}};
}

}  // namespace burnish::inline solid
