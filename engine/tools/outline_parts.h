#pragma once
#include <Eigen/Dense>
#include <functional>
#include <numbers>
#include <vector>

#include "engine/tools/surface_mesh.h"

/// Pieces that outlines are made of.
namespace burnish::inline tools {

using OutlinePoints = std::vector<Eigen::Vector3d>;

/// Round shapes are drawn in pieces of 5 degrees.
inline constexpr int kPiecesAround = 72;
inline constexpr double kPieceAngle = std::numbers::pi / 36.0;

/// A full circle in the plane of two orthonormal directions, its last point left out.
OutlinePoints ring(const Eigen::Vector3d& center, double radius, const Eigen::Vector3d& a,
                   const Eigen::Vector3d& b);

/// A rounded wedge from the end of one flank to that of the other, `across` to the right of somebody who
/// looks back from the front. halfAngle: radians.
OutlinePoints wedge(const Eigen::Vector3d& tip, const Eigen::Vector3d& front, const Eigen::Vector3d& across,
                    double halfAngle, double radius, double reach);

/// The surface of a profile that is turned about an axis: its points by their distance from the axis and
/// height along it. closed: its last point is joined to the first.
SurfaceMesh revolved(const std::vector<Eigen::Vector2d>& profile, const Eigen::Vector3d& center,
                     const Eigen::Vector3d& axis, bool closed);

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

}  // namespace burnish::inline tools
