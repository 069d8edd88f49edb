#pragma once
#include <array>
#include <optional>

#include "engine/results/result.h"

namespace burnish {

struct FieldChoice;

/// The smallest and the largest value that a field takes anywhere on a mesh, to 1e-6 of their distance; nothing
/// if one is not finite. field: not one of contact. Bernstein coefficients bound the field on its spans; the
/// span with the best bound is halved until no bound is better than a value that the field has.
std::optional<std::array<double, 2>> exactRange(const MeshRecord& mesh, const FieldChoice& field);

}  // namespace burnish
