#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>
#include <vector>

#include "postproc/mesh/plane_section.h"
#include "postproc/mesh/poly_builder.h"
#include "postproc/mesh/recorded_shape.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

constexpr int kCircleSegments = 360;

/// A number of chords, `fewest` times a power of two, from which a circle is no farther than `error`; `most` at most.
int segmentsOf(double radius, double error, int fewest, int most) {
  int count = fewest;
  while (count < most && radius * (1.0 - std::cos(std::numbers::pi / count)) > error) count *= 2;
  return count;
}

/// Points of a circle, not closed: 3 x n. The axes are orthonormal.
Eigen::MatrixXd circlePoints(const Eigen::Vector3d& center, double radius, const Eigen::Vector3d& axis1,
                             const Eigen::Vector3d& axis2, double error) {
  constexpr int kMost = 256 * kCircleSegments;
  const int count = segmentsOf(radius, error, kCircleSegments, kMost);
  Eigen::MatrixXd points(3, count);
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    points.col(i) = center + radius * (std::cos(angle) * axis1 + std::sin(angle) * axis2);
  }
  return points;
}

vtkSmartPointer<vtkPolyData> closedCircle(const Eigen::Vector3d& center, double radius, double error) {
  PolyBuilder builder;
  std::vector<vtkIdType> points = builder.addPoints(
      circlePoints(center, radius, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), error));
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
  double error;

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
    return closedCircle(cylinder.center, cylinder.radius, error);
  }
  vtkSmartPointer<vtkPolyData> operator()(const Sphere& sphere) const {
    return closedCircle(sphere.center, sphere.radius, error);
  }
  vtkSmartPointer<vtkPolyData> operator()(const SurfaceMesh& mesh) const { return cellsOf(mesh); }
};

struct SpatialOutline {
  const Eigen::AlignedBox3d& box;
  double error;

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
    const auto lower = builder.addPoints(circlePoints(foot + begin * axis, cylinder.radius, a, b, error));
    const auto upper = builder.addPoints(circlePoints(foot + end * axis, cylinder.radius, a, b, error));
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
    constexpr int kMeridians = 96, kMostMeridians = 4 * kMeridians;
    const int meridians = segmentsOf(sphere.radius, error, kMeridians, kMostMeridians);
    source->SetThetaResolution(meridians);
    source->SetPhiResolution(meridians / 2);
    source->Update();
    const auto surface = vtkSmartPointer<vtkPolyData>::New();
    surface->SetPoints(source->GetOutput()->GetPoints());
    surface->SetPolys(source->GetOutput()->GetPolys());
    Eigen::Matrix3Xd normals(3, surface->GetNumberOfPoints());
    for (Eigen::Index k = 0; k < normals.cols(); ++k)
      normals.col(k) = (Eigen::Vector3d(surface->GetPoint(k)) - center).normalized();
    surface->GetPointData()->SetNormals(makeArray("normals", normals, {}));
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

}  // namespace

vtkSmartPointer<vtkPolyData> toolOutline(const ToolRecord& tool, int dim, const Eigen::AlignedBox3d& box,
                                         double error) {
  return dim == 2 ? std::visit(PlanarOutline{box, error}, tool.shape)
                  : std::visit(SpatialOutline{box, error}, tool.shape);
}

vtkSmartPointer<vtkPolyData> toolSection(const ToolRecord& tool, const Eigen::AlignedBox3d& box,
                                         const CutPlane& plane, double error) {
  const auto* sphere = std::get_if<Sphere>(&tool.shape);
  if (!sphere) return sectionOf(*toolOutline(tool, 3, box, error), plane);
  const Eigen::Vector3d normal = plane.normal.normalized(), a = normal.unitOrthogonal();
  const double height = normal.dot(sphere->center - plane.point),
               square = sphere->radius * sphere->radius - height * height;
  PolyBuilder builder;
  if (square <= 0.0) return builder.finish();
  const auto points = builder.addPoints(
      circlePoints(sphere->center - height * normal, std::sqrt(square), a, normal.cross(a), error));
  for (std::size_t k = 0; k < points.size(); ++k)
    builder.addLine({points[k], points[(k + 1) % points.size()]});
  return builder.finish();
}

}  // namespace burnish
