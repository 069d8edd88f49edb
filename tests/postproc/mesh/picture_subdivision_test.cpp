#include "postproc/mesh/picture_subdivision.h"

#include <gtest/gtest.h>
#include <vtkCleanPolyData.h>
#include <vtkFeatureEdges.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/exact_range.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/mesh/body_surface.h"
#include "postproc/mesh/mirror.h"
#include "postproc/mesh/outlines.h"
#include "tests/engine/analysis/model_samples.h"
#include "tests/postproc/sample_records.h"

/// Pictures of plane bodies are as exact as they are to be, and the ends of their colours are those of the field.
namespace burnish {
namespace {

using namespace samples;

const Eigen::AlignedBox2d kWholePicture(Eigen::Vector2d(-10.0, -10.0), Eigen::Vector2d(10.0, 10.0));

BodySurface trianglesOf(const MeshRecord& mesh, const Subdivision& subdivision) {
  return {mesh, subdivision, BodySurface::Faces::Outside, BodySurface::Cells::TrianglesAboutMiddles};
}

Eigen::Vector3d placeOf(vtkPolyData& data, vtkIdType k) {
  return Eigen::Map<const Eigen::Vector3d>(data.GetPoint(k));
}

/// Edges that only one triangle has.
vtkSmartPointer<vtkPolyData> borderOf(vtkPolyData& shape) {
  vtkNew<vtkCleanPolyData> joined;
  joined->SetInputData(&shape);
  joined->SetTolerance(1e-9);
  vtkNew<vtkFeatureEdges> border;
  border->SetInputConnection(joined->GetOutputPort());
  border->FeatureEdgesOff();
  border->Update();
  return border->GetOutput();
}

TEST(PictureSubdivision, KeepsCurvedEdgesWithinTheTolerance) {
  for (const Patch<2>& ring : {quarterRing(), lagrangeRing()})
    for (const double tolerance : {0.05, 0.005, 0.0005}) {
      const ModelRecord model = modelOf(ring);
      const auto outline = bodyOutline(
          model.mesh, {}, pictureSubdivision(model.mesh, {}, {tolerance, kWholePicture}, nullptr));
      double worst = 0.0;
      vtkNew<vtkIdList> ids;
      for (vtkIdType line = 0; line < outline->GetNumberOfCells(); ++line) {
        outline->GetCellPoints(line, ids);
        for (vtkIdType k = 0; k + 1 < ids->GetNumberOfIds(); ++k) {
          const Eigen::Vector3d begin = placeOf(*outline, ids->GetId(k)),
                                end = placeOf(*outline, ids->GetId(k + 1));
          if (std::min(begin.norm(), end.norm()) > kOuterRadius - 1e-3)
            worst = std::max(worst, 0.5 * (begin.norm() + end.norm() - (begin + end).norm()));
        }
      }
      EXPECT_LE(worst, tolerance);
      EXPECT_GE(worst, tolerance / 30.0);  // nor are there many more cells than needed
    }
}

/// Where a picture shows a thousandth or a ten thousandth of a span it has cells of its own, and is as exact.
TEST(PictureSubdivision, FollowsTheZoomIntoSpans) {
  const ModelRecord model = modelOf(quarterRing());
  const Eigen::Vector2d middle = kOuterRadius * Eigen::Vector2d(std::cos(0.6), std::sin(0.6));
  for (const double width : {1e-2, 1e-3, 1e-4}) {
    const Eigen::AlignedBox2d window(middle.array() - width / 2, middle.array() + width / 2);
    const double tolerance = width * width / 1000.0;
    const Subdivision cells = pictureSubdivision(model.mesh, {}, {tolerance, window}, nullptr);
    const auto outline = bodyOutline(model.mesh, {}, cells);
    double worst = 0.0;
    int numSeen = 0;
    vtkNew<vtkIdList> ids;
    for (vtkIdType line = 0; line < outline->GetNumberOfCells(); ++line) {
      outline->GetCellPoints(line, ids);
      for (vtkIdType k = 0; k + 1 < ids->GetNumberOfIds(); ++k) {
        const Eigen::Vector3d half =
            0.5 * (placeOf(*outline, ids->GetId(k)) + placeOf(*outline, ids->GetId(k + 1)));
        if (!window.contains(half.head<2>())) continue;
        worst = std::max(worst, kOuterRadius - half.norm());
        ++numSeen;
      }
    }
    EXPECT_GT(numSeen, 2) << width;
    EXPECT_LE(worst, tolerance) << width;
    EXPECT_GE(worst, tolerance / 30.0) << width;
    EXPECT_LT(trianglesOf(model.mesh, cells).displaced({})->GetNumberOfCells(), 200'000);
  }
}

/// Where two patches meet.
TEST(PictureSubdivision, LeavesNoCracksWhereOneLooksIntoSpans) {
  ModelRecord model = modelOf(quarterRing());
  FrameRecord still = frameOf(model, 0, 0.0);
  still.displacement.setZero();
  MeshRecord mesh = mirrored(model, still, {{0, 0.0}}).model.mesh;
  ASSERT_EQ(mesh.patches.size(), 2U);
  const double width = 1e-3;
  for (const double place : {0.3, 0.6}) {  // along the edge
    const Eigen::Vector2d middle(0.0, std::lerp(kInnerRadius, kOuterRadius, place));
    const Eigen::AlignedBox2d window(middle.array() - width / 2, middle.array() + width / 2);
    const ValueTolerance values{randomCoefficients(1, mesh.numNodes, 1), 1e-4, {-10.0, 10.0}};
    const Subdivision cells = pictureSubdivision(mesh, {}, {width * width / 1000.0, window}, &values);
    const auto shape = trianglesOf(mesh, cells).displaced({});
    const auto border = borderOf(*shape);
    double inside = 0.0;  // length of edges of one triangle within the body
    for (vtkIdType line = 0; line < border->GetNumberOfCells(); ++line) {
      vtkNew<vtkIdList> ids;
      border->GetCellPoints(line, ids);
      const Eigen::Vector3d half = 0.5 * (placeOf(*border, ids->GetId(0)) + placeOf(*border, ids->GetId(1)));
      if (std::abs(half.x()) < 1e-6) inside += 1.0;
    }
    EXPECT_EQ(inside, 0.0);
  }
}

TEST(PictureSubdivision, CutsAreTurnedWithTheirSpan) {
  const SpanCells cells{64, {0.0078125, 0.26171875}};
  EXPECT_EQ(cells.reversed(), (SpanCells{64, {0.73828125, 0.9921875}}));
  EXPECT_EQ(cells.reversed().reversed(), cells);
  SpanCells both{32, {0.5078125}};
  both.refine(cells);
  EXPECT_EQ(both, (SpanCells{64, {0.0078125, 0.26171875, 0.5078125}}));
}

/// A face that is seen along itself, and one that is curved so: all of it lies before and behind what is seen.
TEST(PictureSubdivision, OfFacesThatAreSeenAlongThemselvesHasAnEnd) {
  const Patch<3> octant = ballOctant({0, 0, 0}, 1.0, {0, 1, 0});
  const ModelRecord model = modelOf(octant);
  PositionTolerance positions{1e-9, {}};
  positions.axes << 0, 1, 0, 0, 0, 1;
  for (const Eigen::Vector2d& middle :
       {Eigen::Vector2d(0.5, 0.0), Eigen::Vector2d(std::sqrt(0.5), std::sqrt(0.5))}) {
    positions.window = {middle.array() - 1e-5, middle.array() + 1e-5};
    const Subdivision cells = pictureSubdivision(model.mesh, {}, positions, nullptr);
    EXPECT_LT(BodySurface(model.mesh, cells).displaced({})->GetNumberOfCells(), 3'000'000);
  }
}

TEST(PictureSubdivision, KeepsValuesWithinTheTolerance) {
  samples::Sample sample = slab({3, 2});
  const Eigen::MatrixXd& strain = sample.frame.fields["plastic_strain"].values;
  const auto exact = [](const Eigen::Vector3d& x) {
    return 4.0 * x(0) / 3.0 * (1.0 - x(0) / 3.0) * x(1) * x(1);
  };
  for (const double tolerance : {0.02, 0.001}) {
    const ValueTolerance values{strain, tolerance, {0.0, 1.0}};
    const BodySurface surface = trianglesOf(
        sample.model.mesh, pictureSubdivision(sample.model.mesh, {}, {1.0, kWholePicture}, &values));
    const auto shape = surface.displaced({});
    const Eigen::RowVectorXd drawn = surface.evaluate(strain);
    double worst = 0.0;
    vtkNew<vtkIdList> ids;
    for (vtkIdType cell = 0; cell < shape->GetNumberOfCells(); ++cell) {
      shape->GetCellPoints(cell, ids);
      ASSERT_EQ(ids->GetNumberOfIds(), 3);
      for (const Eigen::Vector3d& part :
           {Eigen::Vector3d(0.5, 0.5, 0.0), Eigen::Vector3d(0.0, 0.5, 0.5), Eigen::Vector3d(0.4, 0.3, 0.3)}) {
        Eigen::Vector3d x = Eigen::Vector3d::Zero();
        double value = 0.0;
        for (int c = 0; c < 3; ++c) {
          x += part(c) * placeOf(*shape, ids->GetId(c));
          value += part(c) * drawn(ids->GetId(c));
        }
        worst = std::max(worst, std::abs(value - exact(x)));
      }
    }
    EXPECT_LE(worst, tolerance);
    EXPECT_GE(worst, tolerance / 30.0);
  }
}

TEST(PictureSubdivision, IsOneCellWhereNothingIsSeenOrToldApart) {
  const ModelRecord model = modelOf(quarterRing());
  const Eigen::AlignedBox2d elsewhere(Eigen::Vector2d(5.0, 5.0), Eigen::Vector2d(6.0, 6.0));
  const auto numCells = [&](const Subdivision& subdivision) {
    return BodySurface(model.mesh, subdivision).displaced({})->GetNumberOfCells();
  };
  EXPECT_EQ(numCells(pictureSubdivision(model.mesh, {}, {1e-6, elsewhere}, nullptr)), 3 * 4);
  ValueTolerance values{randomCoefficients(1, model.mesh.numNodes, 1), 1e-6, {2.0, 3.0}};
  EXPECT_EQ(numCells(pictureSubdivision(model.mesh, {}, {10.0, kWholePicture}, &values)), 3 * 4);
  values.range = {-1.0, 1.0};
  EXPECT_EQ(numCells(pictureSubdivision(model.mesh, {}, {10.0, kWholePicture}, &values)),
            3 * 4 * kMostCellsOfPicture * kMostCellsOfPicture);
}

TEST(PictureSubdivision, LeavesNoCracksBetweenPatches) {
  ModelRecord model = modelOf(quarterRing());
  FrameRecord still = frameOf(model, 0, 0.0);
  still.displacement.setZero();
  const ModelFrame whole = mirrored(model, still, {{0, 0.0}, {1, 0.0}});
  const MeshRecord& mesh = whole.model.mesh;
  ASSERT_EQ(mesh.patches.size(), 4U);
  ValueTolerance values{Eigen::MatrixXd::Zero(1, mesh.numNodes), 0.01, {0.0, 1.0}};
  values.coefficients(0, mesh.patches[2].nodes[7]) = 1.0;  // one patch needs many cells
  const auto shape =
      trianglesOf(mesh, pictureSubdivision(mesh, {}, {0.1, kWholePicture}, &values)).displaced({});
  const auto border = borderOf(*shape);
  vtkPolyData& edges = *border;
  ASSERT_GT(edges.GetNumberOfPoints(), 0);
  for (vtkIdType k = 0; k < edges.GetNumberOfPoints(); ++k) {
    const double radius = placeOf(edges, k).norm();
    EXPECT_LT(std::min(std::abs(radius - kInnerRadius), std::abs(radius - kOuterRadius)), 1e-6);
  }
}

/// Two quarters of a tube, one of whose faces needs many cells.
TEST(PictureSubdivision, LeavesNoCracksBetweenPatchesInSpace) {
  const double quarter = std::numbers::pi / 2.0;
  ModelRecord model =
      modelOf(refined(cylinderSegment({0.0, 0.0, 0.0}, kInnerRadius, kOuterRadius, 0.0, quarter, 1.0),
                      {KnotVector::uniform(2, 2), KnotVector::uniform(2, 3), KnotVector::uniform(2, 2)}));
  FrameRecord still = frameOf(model, 0, 0.0);
  still.displacement.setZero();
  const ModelFrame half = mirrored(model, still, {{0, 0.0}});
  const MeshRecord& mesh = half.model.mesh;
  ASSERT_EQ(mesh.patches.size(), 2U);
  ValueTolerance values{Eigen::MatrixXd::Zero(1, mesh.numNodes), 0.01, {0.0, 1.0}};
  values.coefficients(0, mesh.patches[1].nodes[0]) = 1.0;
  for (const double tolerance : {0.1, 0.01}) {
    const Subdivision cells = pictureSubdivision(mesh, {}, {tolerance, kWholePicture}, &values);
    const auto shape = trianglesOf(mesh, cells).displaced({});
    EXPECT_EQ(borderOf(*shape)->GetNumberOfCells(), 0);  // the surface is closed
    double worst = 0.0;
    vtkNew<vtkIdList> ids;
    for (vtkIdType cell = 0; cell < shape->GetNumberOfCells(); ++cell) {
      shape->GetCellPoints(cell, ids);
      for (vtkIdType k = 0; k < 3; ++k) {
        const Eigen::Vector2d one = placeOf(*shape, ids->GetId(k)).head<2>(),
                              other = placeOf(*shape, ids->GetId((k + 1) % 3)).head<2>();
        for (const double radius : {kInnerRadius, kOuterRadius})
          if (std::abs(one.norm() - radius) < 1e-9 && std::abs(other.norm() - radius) < 1e-9)
            worst = std::max(worst, radius - 0.5 * (one + other).norm());
      }
    }
    EXPECT_LE(worst, tolerance);
    EXPECT_GT(worst, tolerance / 100.0);
  }
}

/// Coefficients on a square of one knot span of degree 2.
struct Square {
  ModelRecord model = modelOf(
      refined(rectangle({0.0, 0.0}, {1.0, 1.0}), {KnotVector::uniform(2, 1), KnotVector::uniform(2, 1)}));
  FrameRecord frame = frameOf(model, 0, 0.0);
};

TEST(FieldRange, IsThatOfTheFieldWhereverItsExtremesLie) {
  Square square;
  Eigen::MatrixXd& stress = square.frame.fields["stress"].values;
  for (int a = 0; a < 9; ++a) stress(0, a) = std::array{0.0, 1.0, 0.4}[static_cast<std::size_t>(a % 3)];
  for (const int cells : {1, 4}) {  // 2 x - 1.6 x² is largest at x = 5/8
    const auto range = fieldRange(square.model, square.frame, "stress.xx", cells);
    EXPECT_EQ(range[0], 0.0);
    EXPECT_NEAR(range[1], 0.625, 1e-6);
  }
}

TEST(FieldRange, OfAMagnitudeMayBeNothingWithinASpan) {
  Square square;
  square.frame.displacement = square.model.mesh.patches.front().points.colwise() - Eigen::Vector2d(0.3, 0.6);
  const auto range = fieldRange(square.model, square.frame, "displacement", 4);
  EXPECT_NEAR(range[0], 0.0, 1e-6);
  EXPECT_NEAR(range[1], std::hypot(0.7, 0.6), 1e-12);
}

TEST(ExactRange, TellsWhereTheExtremesAre) {
  Square square;
  const MeshRecord& mesh = square.model.mesh;
  square.frame.displacement = mesh.patches.front().points.colwise() - Eigen::Vector2d(0.3, 0.6);
  const auto range = exactRange(mesh, chooseField(square.model, square.frame, "displacement"));
  ASSERT_TRUE(range);
  const Eigen::MatrixXd still = Eigen::MatrixXd::Zero(2, mesh.numNodes);
  EXPECT_LT((positionOf(range->places[0], mesh, still) - Eigen::Vector2d(0.3, 0.6)).norm(), 1e-6);
  EXPECT_LT((positionOf(range->places[1], mesh, still) - Eigen::Vector2d(1.0, 0.0)).norm(), 1e-15);
  EXPECT_LT(
      (positionOf(range->places[1], mesh, square.frame.displacement) - Eigen::Vector2d(1.7, -0.6)).norm(),
      1e-15);
}

TEST(ExactRange, TellsThePlaceWithinAnyPatchAndSpan) {
  const ModelRecord model = modelOf(quarterRing());
  FrameRecord still = frameOf(model, 0, 0.0);
  still.displacement.setZero();
  const ModelFrame whole = mirrored(model, still, {{0, 0.0}, {1, 0.0}});
  const MeshRecord& mesh = whole.model.mesh;
  FieldChoice choice = chooseField(whole.model, whole.frame, "pressure");
  Eigen::MatrixXd& field = choice.coefficients;
  field.resize(1, mesh.numNodes);  // the part of the position along (3, 4) / 5
  for (const PatchRecord& patch : mesh.patches)
    for (std::size_t a = 0; a < patch.nodes.size(); ++a)
      field(0, patch.nodes[a]) =
          patch.points.col(static_cast<Eigen::Index>(a)).dot(Eigen::Vector2d(0.6, 0.8));
  const auto range = exactRange(mesh, choice);
  ASSERT_TRUE(range);
  for (const std::size_t end : {0U, 1U}) {
    const double sign = end == 0 ? -1.0 : 1.0;
    EXPECT_NEAR(range->values[end], sign * kOuterRadius, 1e-6 * kOuterRadius);
    // At a maximum a value within 1e-6 leaves the place its root.
    EXPECT_LT((positionOf(range->places[end], mesh, whole.frame.displacement) -
               sign * kOuterRadius * Eigen::Vector2d(0.6, 0.8))
                  .norm(),
              4e-3 * kOuterRadius);
  }
}

TEST(FieldRange, OfARationalFieldIsNeverExceededBySamples) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const ModelRecord model = modelOf(quarterRing());
    const FrameRecord frame = frameOf(model, static_cast<int>(seed), 0.0);
    const Eigen::MatrixXd samples = BodySurface(model.mesh, 60).evaluate(frame.fields.at("pressure").values);
    const auto range = fieldRange(model, frame, "pressure", 1);
    const double tolerance = 1e-6 * (range[1] - range[0]);
    EXPECT_LE(range[0], samples.minCoeff() + tolerance);
    EXPECT_GE(range[1], samples.maxCoeff() - tolerance);
    EXPECT_NEAR(range[0], samples.minCoeff(), 1e-3);
    EXPECT_NEAR(range[1], samples.maxCoeff(), 1e-3);
  }
}

}  // namespace
}  // namespace burnish
