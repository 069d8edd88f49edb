#include <vtkBox.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>
#include <vector>

#include "postproc/mesh/outlines.h"
#include "postproc/mesh/poly_builder.h"

namespace burnish {
namespace {

constexpr int kCircleSegments = 360;

/// Points of a circle, not closed: 3 x kCircleSegments. The axes are orthonormal.
Eigen::MatrixXd circlePoints(const Eigen::Vector3d& center, double radius, const Eigen::Vector3d& axis1,
                             const Eigen::Vector3d& axis2) {
  Eigen::MatrixXd points(3, kCircleSegments);
  for (int i = 0; i < kCircleSegments; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCircleSegments;
    points.col(i) = center + radius * (std::cos(angle) * axis1 + std::sin(angle) * axis2);
  }
  return points;
}

vtkSmartPointer<vtkPolyData> closedCircle(const Eigen::Vector3d& center, double radius) {
  PolyBuilder builder;
  std::vector<vtkIdType> points =
      builder.addPoints(circlePoints(center, radius, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()));
  points.push_back(points.front());
  builder.addLine(points);
  return builder.finish();
}

/// Half the length that is drawn of an infinite tool: enough to reach past the box on both sides.
double reach(const Eigen::AlignedBox3d& box) {
  return 0.6 * box.diagonal().norm();
}

/// The point of the plane that is nearest to the middle of the box.
Eigen::Vector3d nearestPoint(const Plane& plane, const Eigen::AlignedBox3d& box) {
  const GapQuery query = plane.query(box.center());
  return box.center() - query.gap * query.normal;
}

vtkSmartPointer<vtkPolyData> cellsOf(const SurfaceMesh& mesh) {
  PolyBuilder builder;
  const auto points = builder.addPoints(mesh.points);
  for (Eigen::Index k = 0; k < mesh.cells.cols(); ++k) {
    std::vector<vtkIdType> cell;
    for (const int point : mesh.cells.col(k)) cell.push_back(points[static_cast<std::size_t>(point)]);
    if (cell.size() == 2)
      builder.addLine(cell);
    else
      builder.addPolygon(cell);
  }
  return builder.finish();
}

struct PlanarOutline {
  const Eigen::AlignedBox3d& box;

  vtkSmartPointer<vtkPolyData> operator()(const Plane& plane) const {
    const Eigen::Vector3d foot = nearestPoint(plane, box);
    const Eigen::Vector3d a =
        reach(box) * Eigen::Vector3d(plane.normal.y(), -plane.normal.x(), 0.0).normalized();
    Eigen::Matrix<double, 3, 2> ends;
    ends << foot - a, foot + a;
    PolyBuilder builder;
    builder.addLine(builder.addPoints(ends));
    return builder.finish();
  }
  vtkSmartPointer<vtkPolyData> operator()(const Cylinder& cylinder) const {
    return closedCircle(cylinder.center, cylinder.radius);
  }
  vtkSmartPointer<vtkPolyData> operator()(const Sphere& sphere) const {
    return closedCircle(sphere.center, sphere.radius);
  }
  vtkSmartPointer<vtkPolyData> operator()(const SurfaceMesh& mesh) const { return cellsOf(mesh); }
};

struct SpatialOutline {
  const Eigen::AlignedBox3d& box;

  vtkSmartPointer<vtkPolyData> operator()(const Plane& plane) const {
    const Eigen::Vector3d n = plane.normal.normalized(), foot = nearestPoint(plane, box);
    Eigen::Index least = 0;
    n.cwiseAbs().minCoeff(&least);
    const Eigen::Vector3d a = n.cross(Eigen::Vector3d::Unit(least)).normalized(), b = n.cross(a);
    const auto [a0, a1] = extentAlong(a);
    const auto [b0, b1] = extentAlong(b);
    const Eigen::Vector3d onPlane = n.dot(foot) * n;
    Eigen::Matrix<double, 3, 4> corners;
    corners << a0 * a + b0 * b, a1 * a + b0 * b, a1 * a + b1 * b, a0 * a + b1 * b;
    corners.colwise() += onPlane;
    PolyBuilder builder;
    builder.addPolygon(builder.addPoints(corners));
    return builder.finish();
  }

  vtkSmartPointer<vtkPolyData> operator()(const Cylinder& cylinder) const {
    const Eigen::Vector3d axis = cylinder.axis.normalized();
    const Eigen::Vector3d a = axis.unitOrthogonal();
    const Eigen::Vector3d b = axis.cross(a);
    const Eigen::Vector3d foot = cylinder.center - axis.dot(cylinder.center) * axis;
    const auto [begin, end] = extentAlong(axis);
    PolyBuilder builder;
    const auto lower = builder.addPoints(circlePoints(foot + begin * axis, cylinder.radius, a, b));
    const auto upper = builder.addPoints(circlePoints(foot + end * axis, cylinder.radius, a, b));
    for (std::size_t i = 0; i < lower.size(); ++i) {
      const std::size_t next = (i + 1) % lower.size();
      builder.addPolygon({lower[i], lower[next], upper[next], upper[i]});
    }
    builder.addPolygon(upper);
    builder.addPolygon({lower.rbegin(), lower.rend()});
    return builder.finish();
  }

  vtkSmartPointer<vtkPolyData> operator()(const Sphere& sphere) const {
    const Eigen::Vector3d center = sphere.center;
    const auto source = vtkSmartPointer<vtkSphereSource>::New();
    source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    source->SetCenter(center.x(), center.y(), center.z());
    source->SetRadius(sphere.radius);
    source->SetThetaResolution(96);
    source->SetPhiResolution(48);
    source->Update();
    const auto surface = vtkSmartPointer<vtkPolyData>::New();
    surface->SetPoints(source->GetOutput()->GetPoints());
    surface->SetPolys(source->GetOutput()->GetPolys());
    return surface;
  }

  vtkSmartPointer<vtkPolyData> operator()(const SurfaceMesh& mesh) const { return cellsOf(mesh); }

 private:
  /// From where to where the box reaches along a direction, and a little further.
  std::pair<double, double> extentAlong(const Eigen::Vector3d& direction) const {
    const double middle = direction.dot(box.center());
    const double half = direction.cwiseAbs().dot(box.sizes()) / 2.0 + 0.1 * box.diagonal().norm();
    return {middle - half, middle + half};
  }
};

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

}  // namespace

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

vtkSmartPointer<vtkPolyData> toolOutline(const ToolRecord& tool, int dim, const Eigen::AlignedBox3d& box) {
  return dim == 2 ? std::visit(PlanarOutline{box}, tool.shape) : std::visit(SpatialOutline{box}, tool.shape);
}

}  // namespace burnish
