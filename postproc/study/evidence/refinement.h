#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace burnish {

/// A number computed on a mesh whose cells have the size `size`, in any unit.
struct MeshValue {
  double size = 1.0;
  double value = 0.0;
};

/// The limit L of f(h) = L + C h^q through three meshes, coarse to fine; nothing if the differences do not
/// shrink with an order q of at least 0.85.
std::optional<double> extrapolatedLimit(const std::array<MeshValue, 3>& meshes);

/// Order of the errors |value - limit| between two meshes; nothing if one of them is zero.
std::optional<double> observedOrder(const MeshValue& coarse, const MeshValue& fine, double limit);

/// Slope of the least-squares line through the logarithms of the errors and of the sizes; nothing for fewer
/// than two errors above zero.
std::optional<double> meanOrder(const std::vector<MeshValue>& meshes, double limit);

}  // namespace burnish
