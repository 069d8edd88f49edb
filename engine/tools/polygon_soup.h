#pragma once
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cstddef>
#include <filesystem>
#include <vector>

namespace burnish::inline tools {

using SoupPoint = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

/// Numbers of the points of each polygon; not checked.
using SoupPolygons = std::vector<std::vector<std::size_t>>;

/// Appends the points and polygons of an STL, OBJ, PLY or OFF file as they stand there. Returns whether it is
/// one; throws Error for what only looks like one.
bool readPolygonSoup(const std::filesystem::path& file, std::vector<SoupPoint>& points,
                     SoupPolygons& polygons);

}  // namespace burnish::inline tools
