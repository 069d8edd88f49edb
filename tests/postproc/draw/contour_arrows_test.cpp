#include "postproc/draw/contour/contour_arrows.h"

#include <gmock/gmock.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "postproc/draw/contour/streamlines.h"
#include "postproc/mesh/poly_builder.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

using Places = std::vector<Eigen::Vector3d>;

/// Points with a displacement of 1 to the right each.
vtkSmartPointer<vtkPolyData> ground(const Places& points, bool inSpace) {
  Eigen::Matrix3Xd x(3, static_cast<Eigen::Index>(points.size()));
  for (Eigen::Index k = 0; k < x.cols(); ++k) x.col(k) = points[static_cast<std::size_t>(k)];
  PolyBuilder builder;
  builder.addPoints(x);
  const auto body = builder.finish();
  body->GetPointData()->AddArray(makeArray("vectors", Eigen::Vector3d::UnitX().replicate(1, x.cols()), {}));
  if (inSpace)
    body->GetPointData()->SetNormals(
        makeArray("normals", Eigen::Vector3d::UnitZ().replicate(1, x.cols()), {}));
  return body;
}

/// Where arrows as long as `longest` begin.
Places beginsOf(const Places& points, double longest, vtkPolyData* before = nullptr, bool inSpace = false,
                const View& view = {}) {
  const ContourArrows arrows = contourArrows(
      ArrowField::Displacement,
      {.dim = inSpace ? 3 : 2, .surface = ground(points, inSpace), .name = "displacement", .unit = ""},
      before, view, longest, {});
  Places begins;
  constexpr vtkIdType kCorners = 8;  // the first of an arrow is its tip
  for (vtkIdType k = 0; arrows.edges && k < arrows.edges->GetNumberOfPoints(); k += kCorners)
    begins.push_back(Eigen::Map<const Eigen::Vector3d>(arrows.edges->GetPoint(k)) -
                     longest * Eigen::Vector3d::UnitX());
  return begins;
}

bool contains(const Places& places, const Eigen::Vector3d& wanted) {
  return std::any_of(places.begin(), places.end(),
                     [&](const Eigen::Vector3d& place) { return (place - wanted).norm() < 1e-9; });
}

/// Points of a mesh that is graded alike on both sides of x = 0 and, unevenly, along y; with or without points on the
/// plane of symmetry, numbered from one end.
Places graded(bool withMiddle) {
  Places points;
  for (double y = -1.0; y < 1.0; y += 0.03 + 0.02 * (y + 1.0))
    for (int i = -20; i <= 20; ++i) {
      if (i == 0 && !withMiddle) continue;
      const double s = i / 20.0;
      points.push_back({0.3 * s + 0.7 * s * std::abs(s), y + 0.05 * s * s, 0.0});
    }
  return points;
}

TEST(ContourArrows, StandInAPatternAsSymmetricAsThePoints) {
  for (const bool inSpace : {false, true})
    for (const bool withMiddle : {false, true})
      for (const double longest : {0.15, 0.21, 0.4}) {
        const Places begins = beginsOf(graded(withMiddle), longest, nullptr, inSpace);
        ASSERT_GT(begins.size(), 8U);
        for (const Eigen::Vector3d& begin : begins)
          EXPECT_TRUE(contains(begins, {-begin.x(), begin.y(), begin.z()}))
              << begin.transpose() << ", longest " << longest;
      }
}

TEST(ContourArrows, AreNotTooCloseAndLeaveNoGaps) {
  const double longest = 0.2, gap = 0.75 * longest;
  const Places points = graded(true), begins = beginsOf(points, longest);
  for (const Eigen::Vector3d& a : begins)
    for (const Eigen::Vector3d& b : begins)
      if (&a != &b) {
        EXPECT_GE((a - b).norm(), gap * (1.0 - 1e-9));
      }
  for (const Eigen::Vector3d& point : points) {
    double nearest = HUGE_VAL;
    for (const Eigen::Vector3d& begin : begins) nearest = std::min(nearest, (begin - point).norm());
    EXPECT_LT(nearest, 1.5 * gap) << point.transpose();
  }
}

/// Patches have a point each where they meet.
TEST(ContourArrows, OnePlaceHasOneArrow) {
  EXPECT_EQ(beginsOf({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 0.5).size(), 3U);
}

/// Seen along -z; a roof over the points with x > 0.
TEST(ContourArrows, AreHiddenByWhatStandsBeforeThem) {
  PolyBuilder roof;
  Eigen::Matrix3Xd corners(3, 4);
  corners << 0, 5, 5, 0, -5, -5, 5, 5, 1, 1, 1, 1;
  roof.addPolygon(roof.addPoints(corners));
  const Places points{{-2, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 2}};
  const Places begins = beginsOf(points, 0.5, roof.finish(), true);
  EXPECT_EQ(begins.size(), 3U);
  for (const Eigen::Vector3d& seen : Places{{-2, 0, 0}, {-1, 0, 0}, {2, 0, 2}})
    EXPECT_TRUE(contains(begins, seen)) << seen.transpose();
}

/// What is far from a near eye is seen close together.
TEST(ContourArrows, DistancesAreThoseThatTheEyeSees) {
  View view;
  view.eye = Eye{{0.0, 0.0}, 1.0, 1.0};
  const Places far{{0, 0, -18}, {0.0, 0.3, -18}, {0.0, -0.3, -18}},
      near{{0, 0, 1}, {0.0, 0.3, 1}, {0.0, -0.3, 1}};
  EXPECT_EQ(beginsOf(far, 0.2, nullptr, true, view).size(), 1U);
  EXPECT_EQ(beginsOf(near, 0.2, nullptr, true, view).size(), 3U);
}

/// A square of triangles in the plane with this normal, in which vectors turn about the origin.
vtkSmartPointer<vtkPolyData> turningSquare(const Eigen::Vector3d& normal) {
  constexpr int kCells = 30;
  Eigen::Matrix3Xd x(3, (kCells + 1) * (kCells + 1)), u(3, x.cols());
  Eigen::Matrix3d frame;
  frame << normal.unitOrthogonal(), normal.cross(normal.unitOrthogonal()), normal;
  for (int j = 0; j <= kCells; ++j)
    for (int i = 0; i <= kCells; ++i) {
      const double a = 1.0 + 1.0 * i / kCells, b = -1.0 + 2.0 * j / kCells;
      x.col(j * (kCells + 1) + i) = frame * Eigen::Vector3d(a, b, 0.7);
      u.col(j * (kCells + 1) + i) = frame * Eigen::Vector3d(-b, a, 0.3);
    }
  PolyBuilder builder;
  const std::vector<vtkIdType> ids = builder.addPoints(x);
  for (int j = 0; j < kCells; ++j)
    for (int i = 0; i < kCells; ++i) {
      const auto at = [&](int di, int dj) {
        return ids[static_cast<std::size_t>((j + dj) * (kCells + 1) + i + di)];
      };
      builder.addPolygon({at(0, 0), at(1, 0), at(1, 1)});
      builder.addPolygon({at(0, 0), at(1, 1), at(0, 1)});
    }
  const auto square = builder.finish();
  square->GetPointData()->AddArray(makeArray("vectors", u, {}));
  return square;
}

Places pointsOf(vtkPolyData& surface) {
  Places points;
  for (vtkIdType k = 0; k < surface.GetNumberOfPoints(); ++k) points.emplace_back(surface.GetPoint(k));
  return points;
}

/// Streamlines of a rotation are circles, whole and in its direction; what goes out of the plane does not count.
TEST(Streamlines, OfARotationAreCircles) {
  for (const Eigen::Vector3d& given : Places{{0, 0, 1}, {1, 2, -2}}) {
    const Eigen::Vector3d normal = given.normalized();
    const double distance = 0.1;
    const auto square = turningSquare(normal);
    const std::vector<Eigen::Matrix3Xd> lines = evenStreamlines(*square, normal, pointsOf(*square), distance);
    ASSERT_GT(lines.size(), 8U);
    std::vector<double> radii;
    for (const Eigen::Matrix3Xd& line : lines) {
      double smallest = HUGE_VAL, largest = 0.0;
      for (Eigen::Index k = 0; k < line.cols(); ++k) {
        EXPECT_NEAR(line.col(k).dot(normal), 0.7, 1e-12);
        const double radius = normal.cross(line.col(k)).norm();
        smallest = std::min(smallest, radius);
        largest = std::max(largest, radius);
        if (k > 0) {
          EXPECT_GT(normal.dot(line.col(k - 1).cross(line.col(k))), 0.0) << "it turns about the normal";
        }
      }
      EXPECT_LT(largest - smallest, 1e-3);
      radii.push_back(smallest);
    }
    std::sort(radii.begin(), radii.end());
    for (std::size_t k = 1; k < radii.size(); ++k)
      if (radii[k] < 2.0) {  // beyond, the square has two parts of a circle
        EXPECT_GT(radii[k] - radii[k - 1], 0.45 * distance);
        EXPECT_LT(radii[k] - radii[k - 1], 2.0 * distance);
      }
  }
}

/// Round a middle inside the square lines close, once and not a second time beside themselves.
TEST(Streamlines, GoRoundALoopOnce) {
  const auto square = turningSquare(Eigen::Vector3d::UnitZ());
  vtkDataArray& u = *square->GetPointData()->GetArray("vectors");
  const Eigen::Vector3d middle(square->GetCenter());
  for (vtkIdType k = 0; k < square->GetNumberOfPoints(); ++k) {
    const Eigen::Vector3d x = Eigen::Map<const Eigen::Vector3d>(square->GetPoint(k)) - middle;
    u.SetTuple3(k, -x.y(), x.x(), 0.0);
  }
  const std::vector<Eigen::Matrix3Xd> lines =
      evenStreamlines(*square, Eigen::Vector3d::UnitZ(), pointsOf(*square), 0.1);
  int loops = 0;
  for (const Eigen::Matrix3Xd& line : lines) {
    double turned = 0.0;
    for (Eigen::Index k = 1; k < line.cols(); ++k) {
      const Eigen::Vector3d a = line.col(k - 1) - middle, b = line.col(k) - middle;
      turned += std::atan2(a.cross(b).z(), a.dot(b));
    }
    EXPECT_LT(turned, 2.0 * M_PI);
    loops += turned > 1.4 * M_PI ? 1 : 0;
  }
  EXPECT_GT(loops, 1);
}

TEST(Streamlines, OfNothingAreNone) {
  const auto still = turningSquare(Eigen::Vector3d::UnitZ());
  still->GetPointData()->GetArray("vectors")->Fill(0.0);
  EXPECT_TRUE(evenStreamlines(*still, Eigen::Vector3d::UnitZ(), pointsOf(*still), 0.1).empty());
}

}  // namespace
}  // namespace burnish
