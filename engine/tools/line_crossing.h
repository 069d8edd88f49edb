#pragma once
#include <Eigen/Dense>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace burnish::inline tools {

/// Two straight pieces of the line through these points, by number, that have a point in common although none
/// follows the other: of several pairs the one that comes first on the line, unless there are thousands.
/// Decided without rounding. closed: the last point is joined to the first.
std::optional<std::pair<std::size_t, std::size_t>> findLineCrossing(
    const std::vector<Eigen::Vector2d>& points, bool closed);

}  // namespace burnish::inline tools
