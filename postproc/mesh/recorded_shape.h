#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <string>

#include "engine/results/result.h"
#include "postproc/mesh/picture_planes.h"

class vtkPolyData;

/// What pictures, files and texts ask of the recorded shape of a tool. Nothing else looks at what it is.
namespace burnish {

/// "cylinder of radius 0.5"
std::string shapeText(const RecordedShape& shape);

/// A shape moved by a rigid motion or mirrored; the tool stays on its side of the cells of a mesh.
RecordedShape mappedShape(const RecordedShape& shape, const Eigen::Affine3d& map);

/// A tool that is turned about its axis, then displaced.
ToolRecord movedTool(const ToolRecord& tool, const Eigen::Vector3d& displacement, double angle);

/// A tool as it stands in a frame, its motion scaled by `warp`: turned and displaced.
ToolRecord placedTool(const ModelRecord& model, const FrameRecord& frame, std::size_t tool,
                      double warp = 1.0);

/// Whether two shapes of one kind and size are the same up to a length.
bool areSame(const RecordedShape& a, const RecordedShape& b, double length);

/// The direction away from a tool that is a plane.
std::optional<Eigen::Vector3d> planeNormal(const RecordedShape& shape);

struct Disc {
  Eigen::Vector3d center;
  double radius;
};

/// The section of a cylinder in two dimensions.
std::optional<Disc> discOf(const RecordedShape& shape);

/// The segments or triangles of a shape that is recorded by them, else null.
const SurfaceMesh* recordedMesh(const RecordedShape& shape);

/// The same of a shape that has no inside: an open one, and a die.
const SurfaceMesh* openMesh(const RecordedShape& shape);

/// Whether a shape encloses the tool, so that a plane cuts areas out of it.
bool hasInside(const RecordedShape& shape);

/// In two dimensions, of a shape without an inside the part in a box, unless nothing of it is there; other
/// shapes as they are.
RecordedShape partIn(const Eigen::AlignedBox3d& box, const RecordedShape& shape);

/// Points (3 x n) that should be seen so that one understands where a tool is, given the box of the body: the
/// corners of the box of what is finite, the foot of the body's centre on a plane, points along the surface
/// of a shape that is given by its mesh.
Eigen::Matrix3Xd toolLandmarks(const ToolRecord& tool, const Eigen::AlignedBox3d& body);

/// The surface of a tool. In 2D one polyline: a plane is a segment that passes the whole of `box`, a cylinder
/// or a sphere a closed circle whose points in their order are also its polygon; of other shapes segments.
/// In 3D polygons, planes and cylinders cut off a little outside the box; a sphere has its normals. error: how far chords may lie
/// inside of their circle, as far as that takes no more than some ten thousand polygons; without it as is fine enough for most pictures, and
/// never coarser.
vtkSmartPointer<vtkPolyData> toolOutline(const ToolRecord& tool, int dim, const Eigen::AlignedBox3d& box,
                                         double error = HUGE_VAL);

/// Segments where a plane cuts the surface of a tool in space; chords are off by `error` at most.
vtkSmartPointer<vtkPolyData> toolSection(const ToolRecord& tool, const Eigen::AlignedBox3d& box,
                                         const CutPlane& plane, double error);

}  // namespace burnish
