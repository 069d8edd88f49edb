#pragma once
#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <optional>

#include "engine/results/result.h"

namespace burnish {

struct FieldChoice;

/// A place in a mesh.
struct FieldPlace {
  std::size_t patch = 0;
  std::array<double, 3> parameters{};  ///< of the patch; two of a surface
};

/// The smallest and the largest value that a field takes, and where it does.
struct ExactRange {
  std::array<double, 2> values;
  std::array<FieldPlace, 2> places;  ///< one of them, where there are several
};

/// Those anywhere on a mesh, to 1e-6 of their distance; nothing if a value is not finite. field: not one of contact. Bernstein
/// coefficients bound the field on its spans; the span with the best bound is halved until no bound is better
/// than a value that the field has.
std::optional<ExactRange> exactRange(const MeshRecord& mesh, const FieldChoice& field);

/// Where a place is with these displacements (dim x nodes of the mesh): dim coordinates.
Eigen::VectorXd positionOf(const FieldPlace& place, const MeshRecord& mesh,
                           const Eigen::MatrixXd& displacement);

}  // namespace burnish
