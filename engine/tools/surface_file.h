#pragma once
#include <filesystem>

#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

/// Throws `Error` if there is no such file, or if it is a directory or a device. kind: "mesh", ... for the
/// message.
void requireFile(const std::filesystem::path& file, const char* kind);

/// Triangulated surface from a file (STL, OBJ, PLY, OFF), its coordinates times `scale`. Points that coincide
/// are merged, polygons are cut into triangles, triangles are turned like their neighbours, and a closed
/// surface is turned outwards. Throws `Error` that counts and places what is wrong: no such file, degenerate
/// triangles, intersections, more than two triangles at an edge, and a rim unless the surface may be `open`.
SurfaceMesh readSurface(const std::filesystem::path& file, double scale, bool open);

/// The same of triangles (numbers of their corners) in the columns of `cells`.
SurfaceMesh soundSurface(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& cells, bool open);

}  // namespace burnish::inline tools
