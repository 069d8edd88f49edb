#include "postproc/draw/contour/free_sky.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "postproc/draw/contour/contour_parts.h"
#include "postproc/draw/contour/contour_view.h"
#include "postproc/draw/contour/occlusion.h"
#include "postproc/mesh/body_surface.h"
#include "postproc/mesh/poly_builder.h"
#include "tests/postproc/sample_records.h"

namespace burnish {
namespace {

using Eigen::Vector3d;

constexpr double kFar = 1e3;

/// Of 256 rays: the worst of those points of a picture that were held against 4096 rays.
constexpr double kRayTolerance = 0.02;

vtkSmartPointer<vtkPolyData> polygon(const Eigen::Matrix3Xd& corners) {
  PolyBuilder builder;
  builder.addPolygon(builder.addPoints(corners));
  return builder.finish();
}

/// Upright in the plane x = 0, so long that it has no ends.
vtkSmartPointer<vtkPolyData> wall(double height) {
  Eigen::Matrix<double, 3, 4> corners;
  corners << 0, 0, 0, 0, -500, 500, 500, -500, 0, 0, height, height;
  return polygon(corners);
}

double shareAt(const FreeSky& sky, const Vector3d& point, const Vector3d& normal) {
  return sky.sharesAt(point, normal, {kFar})(0);
}

TEST(FreeSky, IsHalfInACorner) {
  const FreeSky sky({wall(200.0)}, {}, 1.0);
  EXPECT_NEAR(shareAt(sky, {0.01, 0.0, 0.0}, Vector3d::UnitZ()), 0.5, kRayTolerance);
}

/// Beside a wall with an end, from points that look in every direction.
TEST(FreeSky, OfAMirrorImageIsTheSame) {
  for (const Eigen::Index axis : {0, 1, 2}) {
    Eigen::Matrix<double, 3, 4> corners;
    corners << 0.1, 0.1, 0.3, 0.2, -0.5, 0.7, 0.6, -0.4, 0, 0, 1, 1;
    const FreeSky sky({polygon(corners)}, {}, 1.0);
    corners.row(axis) *= -1.0;
    const FreeSky image({polygon(corners)}, {}, 1.0);
    for (const Vector3d& normal :
         {Vector3d(0, 0, 1), Vector3d(-1, 0, 0), Vector3d(-1, 2, 3), Vector3d(-3, -2, 1)})
      for (const double x : {-0.3, -0.05, 0.15}) {
        Vector3d place(x, 0.1, 0.05), n = normal.normalized();
        const double share = shareAt(sky, place, n);
        place(axis) *= -1.0;
        n(axis) *= -1.0;
        EXPECT_NEAR(shareAt(image, place, n), share, 1e-9) << axis << ", " << normal.transpose() << ", " << x;
      }
  }
}

TEST(FreeSky, BesideAWallIsThatOfTheFormFactor) {
  const FreeSky sky({wall(1.0)}, {}, 1.0);
  for (const double d : {0.2, 0.5, 1.0, 2.0, 5.0})
    EXPECT_NEAR(shareAt(sky, {d, 0.0, 0.0}, Vector3d::UnitZ()), 1.0 - 0.5 * (1.0 - d / std::hypot(d, 1.0)),
                kRayTolerance)
        << d;
}

/// In whichever unit lengths are told.
TEST(FreeSky, DoesNotDependOnTheSize) {
  for (const double size : {1e-20, 1e19, 1e30}) {
    Eigen::Matrix<double, 3, 4> corners;
    corners << 0, 0, 0, 0, -500, 500, 500, -500, 0, 0, 1, 1;
    const FreeSky sky({polygon(size * corners)}, {}, 1.0);
    EXPECT_NEAR(sky.sharesAt(Vector3d(size, 0.0, 0.0), Vector3d::UnitZ(), {size * kFar})(0),
                1.0 - 0.5 * (1.0 - std::sqrt(0.5)), kRayTolerance)
        << size;
  }
}

TEST(FreeSky, DoesNotDependOnThePlace) {
  for (const double far : {-1e8, 1e8}) {
    Eigen::Matrix<double, 3, 4> corners;
    corners << 0, 0, 0, 0, -500, 500, 500, -500, 0, 0, 1, 1;
    const FreeSky sky({polygon((corners.array() + far).matrix())}, {}, 1.0);
    EXPECT_NEAR(sky.sharesAt(Vector3d(1.0 + far, far, far), Vector3d::UnitZ(), {kFar})(0),
                1.0 - 0.5 * (1.0 - std::sqrt(0.5)), kRayTolerance)
        << far;
  }
}

TEST(FreeSky, UnderADiscIsThatOfTheFormFactor) {
  Eigen::Matrix3Xd circle(3, 720);
  for (Eigen::Index k = 0; k < circle.cols(); ++k) {
    const double angle = std::numbers::pi * static_cast<double>(k) / 360.0;
    circle.col(k) << 0.7 * std::cos(angle), 0.7 * std::sin(angle), 1.0;
  }
  const double covered = 0.49 / 1.49;
  const FreeSky solid({polygon(circle)}, {}, 1.0), translucent({}, {polygon(circle)}, 0.3);
  EXPECT_NEAR(shareAt(solid, Vector3d::Zero(), Vector3d::UnitZ()), 1.0 - covered, kRayTolerance);
  EXPECT_NEAR(shareAt(translucent, Vector3d::Zero(), Vector3d::UnitZ()), 1.0 - 0.3 * covered, kRayTolerance);
  EXPECT_EQ(solid.sharesAt(Vector3d::Zero(), Vector3d::UnitZ(), {0.9})(0), 1.0);
  EXPECT_EQ(shareAt(solid, Vector3d::Zero(), -Vector3d::UnitZ()), 1.0);
}

TEST(FreeSky, RaysThatBeginBelowMeetAToolThatIsPressedIn) {
  const auto tool = polygon(Eigen::Matrix<double, 3, 4>{
      {-9.0, 9.0, 9.0, -9.0}, {-9.0, -9.0, 9.0, 9.0}, {-0.01, -0.01, -0.01, -0.01}});
  const FreeSky sky({}, {tool}, 1.0);
  const Vector3d point = Vector3d::Zero(), up = Vector3d::UnitZ();
  EXPECT_EQ(sky.sharesAt(point, up, {1.0})(0), 1.0);
  EXPECT_EQ(sky.sharesAt(point, up, {1.0, 0.0, -0.02})(0), 0.0);
}

TEST(FreeSky, OfAConvexBodyIsAllOfIt) {
  const auto body = BodySurface(samples::cube().model.mesh, 4).displaced({});
  const FreeSky sky({body}, {}, 1.0);
  for (vtkIdType k = 0; k < body->GetNumberOfPoints(); ++k) {
    const Vector3d x(body->GetPoint(k)), n(body->GetPointData()->GetNormals()->GetTuple3(k));
    EXPECT_EQ(sky.sharesAt(x, n, {1.0, 1e-3, 0.0})(0), 1.0);
  }
}

TEST(FreeSky, DoesNotDependOnThreads) {
  const FreeSky sky({wall(1.0)}, {wall(2.0)}, 0.4);
  Eigen::Matrix3Xd points(3, 1000);
  for (Eigen::Index k = 0; k < points.cols(); ++k)
    points.col(k) << 0.01 * static_cast<double>(k + 1), 0.0, 0.1;
  const Eigen::Matrix3Xd up = Vector3d::UnitZ().replicate(1, points.cols());
  const Eigen::VectorXd many = sky.sharesAt(points, up, {kFar});
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(sky.sharesAt(points, up, {kFar}), many);
}

/// A drum of radius and height 1 on the ground: round it at one distance the shadow is the same.
TEST(GroundShadow, FollowsARoundBase) {
  constexpr int kSides = 180;
  PolyBuilder builder;
  const auto rim = [&](double y) {
    Eigen::Matrix3Xd points(3, kSides);
    for (int k = 0; k < kSides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kSides;
      points.col(k) << std::cos(angle), y, std::sin(angle);
    }
    return points;
  };
  const Eigen::Matrix3Xd foot = rim(0.0), top = rim(1.0);
  builder.addPolygon(builder.addPoints(foot));
  builder.addPolygon(builder.addPoints(top));
  for (int k = 0; k < kSides; ++k) {
    const int next = (k + 1) % kSides;
    Eigen::Matrix<double, 3, 4> side;
    side << foot.col(k), foot.col(next), top.col(next), top.col(k);
    builder.addPolygon(builder.addPoints(side));
  }
  ContourParts parts;
  parts.body = builder.finish();
  parts.axes = viewFrom({1.0, 1.0, 1.0});
  parts.box = boxOf(*parts.body);
  const auto ground = Occlusion(parts, {}, 1.0).groundShadow();
  ASSERT_NE(ground, nullptr);
  vtkDataArray& colors = *ground->GetPointData()->GetScalars();
  const auto extent = static_cast<int>(std::lround(std::sqrt(ground->GetNumberOfPoints())));
  const double low = ground->GetBounds()[0], step = (ground->GetBounds()[1] - low) / (extent - 1);
  const auto darkness = [&](double x, double z) {  // as it is drawn, between four points
    const double u = (z - low) / step, v = (x - low) / step;
    const int i = static_cast<int>(u), j = static_cast<int>(v);
    const auto at = [&](int a, int b) { return colors.GetComponent(a + b * extent, 3); };
    return std::lerp(std::lerp(at(i, j), at(i + 1, j), u - i),
                     std::lerp(at(i, j + 1), at(i + 1, j + 1), u - i), v - j);
  };
  for (const double radius : {1.005, 1.03, 1.1}) {
    double least = 255.0, most = 0.0;
    for (int k = 0; k < 720; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / 720;
      const double dark = darkness(radius * std::cos(angle), radius * std::sin(angle));
      least = std::min(least, dark);
      most = std::max(most, dark);
    }
    EXPECT_LT(most - least, 8.0) << "levels of 255, at " << radius;
    EXPECT_GT(least, 40.0) << radius;
  }
}

}  // namespace
}  // namespace burnish
