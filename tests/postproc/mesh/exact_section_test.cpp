#include "postproc/mesh/exact_section.h"

#include <gtest/gtest.h>
#include <vtkCleanPolyData.h>
#include <vtkFeatureEdges.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/nurbs/inverse_map.h"
#include "postproc/mesh/mirror.h"
#include "postproc/mesh/tessellation.h"
#include "tests/engine/analysis/model_samples.h"

/// Sections of a quarter of a tube by a slanted plane.
namespace burnish {
namespace {

using namespace samples;

const Eigen::AlignedBox2d kEverything(Eigen::Vector2d(-10.0, -10.0), Eigen::Vector2d(10.0, 10.0));
const CutPlane kSlanted{{0.0, 0.0, 0.5}, {0.1, 0.1, 1.0}};
constexpr double kQuarter = std::numbers::pi / 2.0;

Patch<3> quarterTube() {
  return refined(cylinderSegment({0.0, 0.0, 0.0}, kInnerRadius, kOuterRadius, 0.0, kQuarter, 1.0),
                 {KnotVector::uniform(2, 2), KnotVector::uniform(2, 2), KnotVector::uniform(2, 1)});
}

SectionTriangles sectionOfMesh(const MeshRecord& mesh, int subdivision, double tolerance,
                               const ValueTolerance* values) {
  FrameRecord still;
  still.displacement = Eigen::MatrixXd::Zero(3, mesh.numNodes);
  const auto grid = makeGrid(Tessellation(mesh, subdivision), still, true);
  addParameters(*grid, mesh, subdivision);
  return exactSection(mesh, still.displacement, kSlanted, *sectionOfCells(*grid, kSlanted),
                      {tolerance, kEverything}, values);
}

double areaOf(vtkPolyData& triangles) {
  double area = 0.0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < triangles.GetNumberOfCells(); ++cell) {
    triangles.GetCellPoints(cell, ids);
    Eigen::Matrix3d x;
    for (int k = 0; k < 3; ++k) triangles.GetPoint(ids->GetId(k), x.col(k).data());
    area += 0.5 * (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).norm();
  }
  return area;
}

/// Of a block that is its own image in x = 1/2, in a plane along x: every triangle has its image.
TEST(ExactSection, OfASymmetricBodyIsSymmetric) {
  const KnotVector knots = KnotVector::uniform(2, 3);
  const ModelRecord model = modelOf(refined(box({0, 0, 0}, {1, 1, 1}), {knots, knots, knots}));
  FrameRecord still;
  still.displacement = Eigen::MatrixXd::Zero(3, model.mesh.numNodes);
  const auto grid = makeGrid(Tessellation(model.mesh, 2), still, true);
  addParameters(*grid, model.mesh, 2);
  const auto section = sectionOfCells(*grid, {{0.5, 0.45, 0.5}, {0.0, 0.3, 1.0}});
  std::vector<Eigen::Vector3d> middles;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < section->GetNumberOfCells(); ++cell) {
    section->GetCellPoints(cell, ids);
    ASSERT_EQ(ids->GetNumberOfIds(), 3);
    Eigen::Matrix3d x;
    for (int k = 0; k < 3; ++k) section->GetPoint(ids->GetId(k), x.col(k).data());
    middles.emplace_back(x.rowwise().mean());
  }
  ASSERT_GT(middles.size(), 30U);
  for (const Eigen::Vector3d& middle : middles) {
    const Eigen::Vector3d image(1.0 - middle.x(), middle.y(), middle.z());
    EXPECT_TRUE(std::ranges::any_of(middles, [&](const Eigen::Vector3d& other) {
      return (other - image).norm() < 1e-9;
    })) << middle.transpose();
  }
}

TEST(ExactSection, LiesInThePlaneAndOnTheBody) {
  const ModelRecord model = modelOf(quarterTube());
  const ValueTolerance values{model.mesh.patches.front().points.topRows(2), 1e-2, {-10.0, 10.0}};
  const Eigen::Vector3d normal = kSlanted.normal.normalized();
  const double exact =
      std::numbers::pi / 4.0 * (kOuterRadius * kOuterRadius - kInnerRadius * kInnerRadius) / normal.z();
  for (const double tolerance : {1e-2, 1e-3}) {
    const SectionTriangles section = sectionOfMesh(model.mesh, 2, tolerance, &values);
    vtkPolyData& surface = *section.surface;
    ASSERT_EQ(section.values.cols(), surface.GetNumberOfPoints());
    double farthest = 0.0, nearest = 10.0;
    for (vtkIdType k = 0; k < surface.GetNumberOfPoints(); ++k) {
      const Eigen::Vector3d x(surface.GetPoint(k));
      EXPECT_LT(std::abs((x - kSlanted.point).dot(normal)), 1e-9);
      EXPECT_LT((section.values.col(k) - x.head<2>()).norm(), 1e-9);  // what is drawn is where the point is
      farthest = std::max(farthest, x.head<2>().norm());
      nearest = std::min(nearest, x.head<2>().norm());
    }
    EXPECT_NEAR(farthest, kOuterRadius, 1e-9);
    EXPECT_NEAR(nearest, kInnerRadius, 1e-9);
    // Chords: two thirds of the tolerance along both arcs at most.
    EXPECT_NEAR(areaOf(surface), exact, 1.1 * tolerance * kQuarter * (kOuterRadius + kInnerRadius));
  }
}

TEST(ExactSection, KeepsValuesWithinTheTolerance) {
  const Patch<3> tube = quarterTube();
  const ModelRecord model = modelOf(tube);
  const Eigen::MatrixXd coefficients = randomCoefficients(1, model.mesh.numNodes, 3);
  const InverseMap<3> map(tube);
  double before = 0.0;
  for (const double tolerance : {0.1, 0.02}) {
    const ValueTolerance values{coefficients, tolerance, {-10.0, 10.0}};
    const SectionTriangles section = sectionOfMesh(model.mesh, 4, 1.0, &values);
    double worst = 0.0;
    vtkNew<vtkIdList> ids;
    for (vtkIdType cell = 0; cell < section.surface->GetNumberOfCells(); ++cell) {
      section.surface->GetCellPoints(cell, ids);
      Eigen::Vector3d middle = Eigen::Vector3d::Zero(), xi = Eigen::Vector3d::Constant(0.5);
      double value = 0.0;
      for (int k = 0; k < 3; ++k) {
        middle += Eigen::Vector3d(section.surface->GetPoint(ids->GetId(k))) / 3.0;
        value += section.values(0, ids->GetId(k)) / 3.0;
      }
      const auto found = map(middle, xi);
      if (!map.arrived(found)) continue;  // beyond an inner arc
      const int span = tube.findSpan(found.xi);
      const double exact =
          coefficients.row(0)(tube.basis().spanFunctions(span)) * tube.shape(span, found.xi).R;
      worst = std::max(worst, std::abs(value - exact));
    }
    EXPECT_LE(worst, 2.0 * tolerance);  // it is measured at the middles of edges
    if (before > 0.0) {
      EXPECT_LT(worst, before);
    }
    before = worst;
  }
}

/// Triangles of different fineness have the same points along their edges, so that nothing shines through.
TEST(ExactSection, HasNoGapsInside) {
  const ModelRecord model = modelOf(quarterTube());
  const ValueTolerance values{randomCoefficients(1, model.mesh.numNodes, 3), 0.02, {-10.0, 10.0}};
  const SectionTriangles section = sectionOfMesh(model.mesh, 3, 1e-3, &values);
  vtkNew<vtkCleanPolyData> joined;
  joined->SetInputData(section.surface);
  joined->SetTolerance(1e-9);
  joined->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkFeatureEdges> border;
  border->SetInputConnection(joined->GetOutputPort());
  border->FeatureEdgesOff();
  border->NonManifoldEdgesOff();
  border->Update();
  vtkPolyData& edges = *border->GetOutput();
  ASSERT_GT(edges.GetNumberOfPoints(), 0);
  for (vtkIdType k = 0; k < edges.GetNumberOfPoints(); ++k) {
    const Eigen::Vector3d x(edges.GetPoint(k));
    const double radius = x.head<2>().norm();
    EXPECT_LT(std::min({std::abs(radius - kInnerRadius), std::abs(radius - kOuterRadius), std::abs(x.x()),
                        std::abs(x.y())}),
              1e-6)
        << x.transpose();
  }
}

TEST(ExactSection, MeetsWherePatchesMeet) {
  ModelRecord model = modelOf(quarterTube());
  FrameRecord still = frameOf(model, 0, 0.0);
  still.displacement.setZero();
  const MeshRecord& mesh = mirrored(model, still, {{0, 0.0}}).model.mesh;
  ASSERT_EQ(mesh.patches.size(), 2U);
  const SectionTriangles section = sectionOfMesh(mesh, 2, 1e-3, nullptr);
  EXPECT_EQ(section.values.size(), 0);
  int onJoint = 0;
  for (vtkIdType k = 0; k < section.surface->GetNumberOfPoints(); ++k) {
    const Eigen::Vector3d x(section.surface->GetPoint(k));
    EXPECT_LT(x.head<2>().norm(), kOuterRadius + 1e-9);
    onJoint += std::abs(x.x()) < 1e-12;
  }
  EXPECT_GT(onJoint, 4);
}

}  // namespace
}  // namespace burnish
