#pragma once
#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "engine/tools/surface_mesh.h"

/// Pieces that outlines are made of.
namespace burnish {

/// Segments through points, from the last to the first too if closed.
SurfaceMesh line(const std::vector<Eigen::Vector3d>& points, bool closed);

/// Triangles between rows of equally many points: outside is where rows go upwards and their points to the
/// right. Rows may be rings, and the last row may be joined to the first. Triangles without area are left
/// out.
SurfaceMesh strips(const std::vector<std::vector<Eigen::Vector3d>>& rows, bool rings, bool joined);

/// The same surface seen from its other side.
SurfaceMesh turnedOver(SurfaceMesh mesh);

/// Every cell cut evenly until no edge is longer than `longest`, or into 64 parts per edge.
SurfaceMesh refined(const SurfaceMesh& mesh, double longest);

/// What is left where a function is not negative; cells are cut where it crosses zero.
SurfaceMesh clipped(const SurfaceMesh& mesh, const std::function<double(const Eigen::Vector3d&)>& function);

/// Whether a shape has the tool inside: it is closed, and no die, which has the body inside.
bool isSolid(const SurfaceMesh& mesh);

/// All cells in one mesh, which is closed if all of them are.
SurfaceMesh together(const std::vector<SurfaceMesh>& meshes);

}  // namespace burnish
