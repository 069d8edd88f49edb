#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/tools/surface_mesh.h"

namespace burnish {

/// Throws `Error` if there is no such file, or if it is a directory or a device. kind: "mesh", ... for the
/// message.
void requireFile(const std::filesystem::path& file, const char* kind);

/// Triangulated surface from a file (STL, OBJ, PLY, OFF), its coordinates times `scale`. Points that coincide
/// are merged, polygons are cut into triangles, triangles are turned like their neighbours, and a closed
/// surface is turned outwards. Throws `Error` that counts and places what is wrong: no such file, degenerate
/// triangles, intersections, more than two triangles at an edge, and a rim unless the surface may be `open`.
SurfaceMesh readSurface(const std::filesystem::path& file, double scale, bool open);

/// Line through points, the tool to its left; a closed line is turned counterclockwise. `place` names the
/// line in messages. Throws `Error` if points coincide or the line crosses itself.
SurfaceMesh polyline(std::vector<Eigen::Vector2d> points, bool closed, const std::string& place);

/// Line through the points of a text file, x and y in every line; empty lines and those that begin with # are
/// passed over. Throws `Error` like `polyline`, and for a line that is not two numbers.
SurfaceMesh readPolyline(const std::filesystem::path& file, bool closed);

}  // namespace burnish
