#include "postproc/mesh/recorded_shape.h"

#include <fmt/format.h>
#include <vtkBox.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "engine/tools/outline_parts.h"

namespace burnish {
namespace {

/// Maps a shape so that lengths stay.
struct ShapeMap {
  const Eigen::Affine3d& map;

  RecordedShape operator()(const Plane& plane) const {
    return Plane{map * plane.origin, map.linear() * plane.normal};
  }
  RecordedShape operator()(const Cylinder& cylinder) const {
    return Cylinder{map * cylinder.center, map.linear() * cylinder.axis, cylinder.radius};
  }
  RecordedShape operator()(const Sphere& sphere) const { return Sphere{map * sphere.center, sphere.radius}; }
  RecordedShape operator()(const SurfaceMesh& mesh) const {
    SurfaceMesh mapped = mesh;
    mapped.points = map * mesh.points;
    // The image in a mirror has the tool on the other side of its cells, unless these go the other way round.
    if (map.linear().determinant() < 0.0) mapped.cells = mesh.cells.colwise().reverse();
    return mapped;
  }
};

/// Whether two shapes of one kind and size are the same up to a length.
struct SameShape {
  static constexpr double kRounding = 1e-9;

  double length;

  bool operator()(const Plane& a, const Plane& b) const {
    return isParallel(a.normal, b.normal) && std::abs((a.origin - b.origin).dot(a.normal)) <= length;
  }
  bool operator()(const Cylinder& a, const Cylinder& b) const {
    return std::abs(std::abs(a.axis.dot(b.axis)) - 1.0) <= kRounding &&
           (a.center - b.center).cross(a.axis).norm() <= length;
  }
  bool operator()(const Sphere& a, const Sphere& b) const { return (a.center - b.center).norm() <= length; }
  bool operator()(const SurfaceMesh& a, const SurfaceMesh& b) const { return places(a) == places(b); }
  template <class A, class B>
  bool operator()(const A&, const B&) const {
    return false;
  }

  /// The points of a mesh up to the length, whatever their order.
  std::set<std::array<std::int64_t, 3>> places(const SurfaceMesh& mesh) const {
    std::set<std::array<std::int64_t, 3>> result;
    const double cell = std::max(length, std::numeric_limits<double>::min());
    for (const auto& x : mesh.points.colwise())
      result.insert({std::llround(x.x() / cell), std::llround(x.y() / cell), std::llround(x.z() / cell)});
    return result;
  }

  static bool isParallel(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return a.dot(b) >= 1.0 - kRounding;
  }
};

struct Landmarks {
  const Eigen::AlignedBox3d& body;

  Eigen::Matrix3Xd operator()(const Plane& plane) const {
    const Eigen::Vector3d n = plane.normal.normalized();
    const double height = (body.center() - plane.origin).dot(n);
    Eigen::Matrix3Xd points(3, 2);
    points.col(0) = body.center() - height * n;
    points.col(1) = points.col(0) - hatchRoom() * n;
    return points;
  }
  Eigen::Matrix3Xd operator()(const Cylinder& cylinder) const {
    return corners(cylinder.center, cylinder.radius);
  }
  Eigen::Matrix3Xd operator()(const Sphere& sphere) const { return corners(sphere.center, sphere.radius); }

  /// Ends of the edges and points along what of them is near the body. A line needs room for hatches at its
  /// left.
  Eigen::Matrix3Xd operator()(const SurfaceMesh& mesh) const {
    const bool hatched = mesh.cells.rows() == 2 && !isSolid(mesh);
    std::vector<Eigen::Vector3d> points;
    for (const auto& cell : mesh.cells.colwise()) {
      const Eigen::Vector3d begin = mesh.points.col(cell(0)), along = mesh.points.col(cell(1)) - begin;
      if (along.norm() == 0.0) continue;
      const Eigen::Vector3d left = hatchRoom() * Eigen::Vector3d::UnitZ().cross(along).normalized();
      for (const double share : sharesNearBody(begin, along)) {
        points.emplace_back(begin + share * along);
        if (hatched) points.emplace_back(points.back() + left);
      }
    }
    return Eigen::Map<const Eigen::Matrix3Xd>(points.front().data(), 3, std::ssize(points));
  }

  std::vector<double> sharesNearBody(const Eigen::Vector3d& begin, const Eigen::Vector3d& along) const {
    constexpr int kPoints = 65;
    const double reach = 2.0 * body.diagonal().norm() / along.norm();
    const double middle = (body.center() - begin).dot(along) / along.squaredNorm();
    const double first = std::clamp(middle - reach, 0.0, 1.0), last = std::clamp(middle + reach, 0.0, 1.0);
    std::vector<double> shares{0.0, 1.0};
    for (int k = 0; k < kPoints; ++k) shares.push_back(std::lerp(first, last, k / (kPoints - 1.0)));
    return shares;
  }

  double hatchRoom() const { return 0.04 * body.diagonal().norm(); }

  Eigen::Matrix3Xd corners(const Eigen::Vector3d& center, double radius) const {
    const Eigen::Vector3d r = Eigen::Vector3d::Constant(radius);
    return corners(Eigen::AlignedBox3d(center - r, center + r));
  }
  Eigen::Matrix3Xd corners(const Eigen::AlignedBox3d& box) const {
    Eigen::Matrix3Xd points(3, 8);
    for (int k = 0; k < 8; ++k) points.col(k) = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k));
    return points;
  }
};

/// The parts of the segments of a plane shape that lie in a box, whose depth does not count.
SurfaceMesh segmentsIn(const SurfaceMesh& mesh, const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d& low = box.min();
  const Eigen::Vector3d& high = box.max();
  const std::array<double, 6> bounds{low.x(), high.x(), low.y(), high.y(), -1.0, 1.0};
  SurfaceMesh inside{Eigen::Matrix3Xd(3, mesh.cells.size()), Eigen::MatrixXi(2, mesh.cells.cols()),
                     mesh.closed};
  int count = 0;
  for (const auto& cell : mesh.cells.colwise()) {
    const Eigen::Vector3d begin = mesh.points.col(cell(0)), end = mesh.points.col(cell(1));
    Eigen::Vector3d first, last;
    double t1 = 0.0, t2 = 0.0;
    int side1 = 0, side2 = 0;
    if (!vtkBox::IntersectWithLine(bounds.data(), begin.data(), end.data(), t1, t2, first.data(), last.data(),
                                   side1, side2))
      continue;
    inside.points.col(2 * count) = first;
    inside.points.col(2 * count + 1) = last;
    inside.cells.col(count) << 2 * count, 2 * count + 1;
    ++count;
  }
  inside.points.conservativeResize(Eigen::NoChange, 2 * count);
  inside.cells.conservativeResize(Eigen::NoChange, count);
  return inside;
}

}  // namespace

std::string shapeText(const RecordedShape& shape) {
  if (const auto* cylinder = std::get_if<Cylinder>(&shape))
    return fmt::format("cylinder of radius {}", cylinder->radius);
  if (const auto* sphere = std::get_if<Sphere>(&shape))
    return fmt::format("sphere of radius {}", sphere->radius);
  if (const SurfaceMesh* mesh = recordedMesh(shape))
    return fmt::format("surface of {} {}", mesh->cells.cols(),
                       mesh->cells.rows() == 2 ? "segments" : "triangles");
  return "plane";
}

RecordedShape mappedShape(const RecordedShape& shape, const Eigen::Affine3d& map) {
  return std::visit(ShapeMap{map}, shape);
}

ToolRecord movedTool(const ToolRecord& tool, const Eigen::Vector3d& displacement, double angle) {
  const Eigen::Affine3d motion(Eigen::Translation3d(tool.pivot + displacement) *
                               Eigen::AngleAxisd(angle, tool.axis) * Eigen::Translation3d(-tool.pivot));
  ToolRecord moved = tool;
  moved.shape = mappedShape(tool.shape, motion);
  moved.pivot += displacement;
  return moved;
}

ToolRecord placedTool(const ModelRecord& model, const FrameRecord& frame, std::size_t tool, double warp) {
  const auto k = static_cast<Eigen::Index>(tool);
  const double angle = frame.toolAngle.size() > k ? warp * frame.toolAngle(k) : 0.0;
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
  displacement.head(frame.toolDisplacement.rows()) = warp * frame.toolDisplacement.col(k);
  return movedTool(model.tools.at(tool), displacement, angle);
}

bool areSame(const RecordedShape& a, const RecordedShape& b, double length) {
  return std::visit(SameShape{length}, a, b);
}

std::optional<Eigen::Vector3d> planeNormal(const RecordedShape& shape) {
  const auto* plane = std::get_if<Plane>(&shape);
  return plane ? std::optional<Eigen::Vector3d>(plane->normal) : std::nullopt;
}

std::optional<Disc> discOf(const RecordedShape& shape) {
  const auto* cylinder = std::get_if<Cylinder>(&shape);
  return cylinder ? std::optional(Disc{cylinder->center, cylinder->radius}) : std::nullopt;
}

const SurfaceMesh* recordedMesh(const RecordedShape& shape) {
  return std::get_if<SurfaceMesh>(&shape);
}

const SurfaceMesh* openMesh(const RecordedShape& shape) {
  const SurfaceMesh* mesh = recordedMesh(shape);
  return mesh && !isSolid(*mesh) ? mesh : nullptr;
}

bool hasInside(const RecordedShape& shape) {
  return !std::holds_alternative<Plane>(shape) && !openMesh(shape);
}

RecordedShape partIn(const Eigen::AlignedBox3d& box, const RecordedShape& shape) {
  const SurfaceMesh* mesh = openMesh(shape);
  if (!mesh) return shape;
  SurfaceMesh part = segmentsIn(*mesh, box);
  return part.cells.size() > 0 ? std::move(part) : shape;
}

Eigen::Matrix3Xd toolLandmarks(const ToolRecord& tool, const Eigen::AlignedBox3d& body) {
  return std::visit(Landmarks{body}, tool.shape);
}

}  // namespace burnish
