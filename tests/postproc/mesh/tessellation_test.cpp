#include "postproc/mesh/tessellation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTriangle.h>
#include <vtkUnstructuredGrid.h>

#include "engine/core/error.h"
#include "engine/results/check_records.h"
#include "engine/solid/joined_body.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/mesh/body_surface.h"
#include "postproc/mesh/mirror.h"
#include "postproc/mesh/outlines.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/plane_section.h"
#include "postproc/mesh/recorded_shape.h"
#include "postproc/mesh/vtk_arrays.h"
#include "tests/engine/analysis/model_samples.h"

namespace burnish {
namespace {

using namespace samples;

/// Parameters of the points of a one-patch surface, 2 x points, in the order of the tessellation.
Eigen::MatrixXd parametersOf(const Patch<2>& patch, int subdivision) {
  const auto xi = subdividedSpans(patch.basis().direction(0), subdivision);
  const auto eta = subdividedSpans(patch.basis().direction(1), subdivision);
  Eigen::MatrixXd parameters(2, static_cast<Eigen::Index>(xi.size() * eta.size()));
  Eigen::Index i = 0;
  for (const double b : eta)
    for (const double a : xi) parameters.col(i++) << a, b;
  return parameters;
}

/// Σ R_A q_A at a parameter point, straight from the patch.
Eigen::VectorXd fieldAt(const Patch<2>& patch, const Eigen::MatrixXd& coefficients,
                        const Eigen::Vector2d& xi) {
  const int span = patch.findSpan(xi);
  const auto functions = patch.basis().spanFunctions(span);
  return coefficients(Eigen::all, functions) * patch.shape(span, xi).R;
}

/// Area of the quadrilaterals, positive if they go round counterclockwise.
double area(const Tessellation& mesh) {
  double sum = 0.0;
  for (const auto& cell : mesh.cells().colwise()) {
    const Eigen::Vector2d d1 = mesh.referencePoints().col(cell(2)) - mesh.referencePoints().col(cell(0));
    const Eigen::Vector2d d2 = mesh.referencePoints().col(cell(3)) - mesh.referencePoints().col(cell(1));
    const double a = 0.5 * (d1.x() * d2.y() - d1.y() * d2.x());
    EXPECT_GT(a, 0.0);
    sum += a;
  }
  return sum;
}

Eigen::Vector3d pointOf(vtkPolyData& data, vtkIdType i) {
  return Eigen::Map<const Eigen::Vector3d>(data.GetPoint(i));
}

TEST(Tessellation, PointsOfARingLieOnItsExactRadii) {
  const Patch<2> ring = quarterRing();
  const Tessellation mesh(modelOf(ring).mesh, 5);
  ASSERT_EQ(mesh.numPoints(), 16 * 21);
  ASSERT_EQ(mesh.numCells(), 15 * 20);
  const Eigen::MatrixXd parameters = parametersOf(ring, 5);
  for (int i = 0; i < mesh.numPoints(); ++i) {
    const double radius = kInnerRadius + (kOuterRadius - kInnerRadius) * parameters(0, i);
    EXPECT_NEAR(mesh.referencePoints().col(i).norm(), radius, 1e-13);
  }
}

TEST(Tessellation, AreaConvergesWithOrderTwo) {
  const double exact = std::numbers::pi / 4.0 * (kOuterRadius * kOuterRadius - kInnerRadius * kInnerRadius);
  const ModelRecord model = modelOf(quarterRing());
  const double coarse = exact - area(Tessellation(model.mesh, 2));
  const double fine = exact - area(Tessellation(model.mesh, 4));
  EXPECT_GT(fine, 0.0);
  EXPECT_NEAR(coarse / fine, 4.0, 0.05);
}

TEST(Tessellation, FieldsEqualTheirRationalSums) {
  for (const Patch<2>& patch : {quarterRing(), lagrangeRing()}) {
    const ModelRecord model = modelOf(patch);
    const Eigen::MatrixXd q = randomCoefficients(4, model.mesh.numNodes, 7);
    const Eigen::MatrixXd values = Tessellation(model.mesh, 3).evaluate(q);
    const Eigen::MatrixXd parameters = parametersOf(patch, 3);
    ASSERT_EQ(values.rows(), 4);
    ASSERT_EQ(values.cols(), parameters.cols());
    for (Eigen::Index i = 0; i < values.cols(); ++i)
      EXPECT_LT((values.col(i) - fieldAt(patch, q, parameters.col(i))).norm(), 1e-14);
  }
}

TEST(Tessellation, CornersOfHexahedraFollowVtk) {
  const Patch<3> block =
      refined(box({0.0, 0.0, 0.0}, {2.0, 3.0, 1.0}),
              {KnotVector::uniform(1, 2), KnotVector::uniform(2, 3), KnotVector::uniform(1, 1)});
  const Tessellation mesh(modelOf(block).mesh, 2);
  ASSERT_EQ(mesh.numCells(), 4 * 6 * 2);
  ASSERT_EQ(mesh.numPoints(), 5 * 7 * 3);
  Eigen::Matrix<double, 3, 8> corners;
  corners << 0, 1, 1, 0, 0, 1, 1, 0,  //
      0, 0, 1, 1, 0, 0, 1, 1,         //
      0, 0, 0, 0, 1, 1, 1, 1;
  for (const auto& cell : mesh.cells().colwise())
    for (int c = 0; c < 8; ++c) {
      const Eigen::Vector3d edge = mesh.referencePoints().col(cell(c)) - mesh.referencePoints().col(cell(0));
      EXPECT_LT((edge - 0.5 * corners.col(c)).norm(), 1e-14);
    }
}

TEST(Tessellation, PatchesThatShareNodesShareValues) {
  const auto square = [](double x) {
    return refined(rectangle({x, 0.0}, {1.0, 1.0}), {KnotVector::uniform(2, 1), KnotVector::uniform(2, 2)});
  };
  ModelRecord model = modelOf(square(0.0));
  PatchRecord right = recordOf(square(1.0));
  for (std::size_t a = 0; a < right.nodes.size(); ++a)
    right.nodes[a] = a % 3 == 0 ? static_cast<int>(a) + 2 : model.mesh.numNodes++;
  model.mesh.patches.push_back(right);

  const Tessellation mesh(model.mesh, 3);
  EXPECT_THAT(mesh.patchOfCell(), testing::Contains(0).Times(18));
  EXPECT_THAT(mesh.patchOfCell(), testing::Contains(1).Times(18));
  const Eigen::MatrixXd values = mesh.evaluate(randomCoefficients(1, model.mesh.numNodes, 1));
  int shared = 0;
  for (int i = 0; i < 28; ++i)
    for (int j = 28; j < mesh.numPoints(); ++j)
      if ((mesh.referencePoints().col(i) - mesh.referencePoints().col(j)).norm() < 1e-12) {
        ++shared;
        EXPECT_NEAR(values(i), values(j), 1e-14);
      }
  EXPECT_EQ(shared, 7);
}

TEST(Tessellation, RefusesWhatDoesNotFit) {
  const ModelRecord model = modelOf(quarterRing());
  EXPECT_THROW(Tessellation(model.mesh, 0), Error);
  EXPECT_THROW(Tessellation(model.mesh, 2).evaluate(Eigen::MatrixXd::Zero(1, model.mesh.numNodes - 1)),
               Error);
  ModelRecord foreignNode = model;
  foreignNode.mesh.patches[0].nodes[3] = model.mesh.numNodes;
  EXPECT_THROW(Tessellation(foreignNode.mesh, 2), Error);
}

TEST(Grid, HoldsTheFieldsInDoublePrecision) {
  const ModelRecord model = modelOf(quarterRing());
  const Tessellation mesh(model.mesh, 2);
  const FrameRecord frame = frameOf(model, 0, 0.0);
  const auto grid = makeGrid(mesh, frame, true);
  ASSERT_EQ(grid->GetPointData()->GetNumberOfArrays(), 5);
  ASSERT_EQ(grid->GetNumberOfCells(), mesh.numCells());
  EXPECT_NE(grid->GetCellData()->GetArray("patch"), nullptr);
  for (const auto& [name, field] : frame.fields) {
    vtkDataArray* array = grid->GetPointData()->GetArray(labelled(name, field.unit).c_str());
    ASSERT_NE(array, nullptr);
    EXPECT_EQ(array->GetDataType(), VTK_DOUBLE);
    const Eigen::MatrixXd values = mesh.evaluate(field.values);
    for (Eigen::Index i = 0; i < values.cols(); ++i)
      for (Eigen::Index c = 0; c < values.rows(); ++c)
        ASSERT_EQ(array->GetComponent(i, static_cast<int>(c)), values(c, i));
  }
  EXPECT_STREQ(grid->GetPointData()->GetArray("stress [MPa]")->GetComponentName(2), "xy");
  EXPECT_STREQ(grid->GetPointData()->GetArray("displacement")->GetComponentName(1), "Y");
}

TEST(Grid, DisplacementLeadsFromReferenceToCurrentPositions) {
  const ModelRecord model = modelOf(lagrangeRing());
  const Tessellation mesh(model.mesh, 2);
  const FrameRecord frame = frameOf(model, 0, 0.0);
  const auto reference = makeGrid(mesh, frame, false);
  const auto current = makeGrid(mesh, frame, true);
  EXPECT_EQ(current->GetPoints()->GetDataType(), VTK_DOUBLE);
  vtkDataArray* u = current->GetPointData()->GetArray("displacement");
  double largest = 0.0;
  for (vtkIdType i = 0; i < current->GetNumberOfPoints(); ++i)
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(reference->GetPoint(i)[c] + u->GetComponent(i, c), current->GetPoint(i)[c]);
      largest = std::max(largest, std::abs(u->GetComponent(i, c)));
    }
  EXPECT_GT(largest, 0.01);
}

/// A curved block of rational functions: part of a tube of degree 2, its wall 1 thick and its height 1.5.
Patch<3> tubePart() {
  return refined(cylinderSegment({0.0, 0.0, 0.0}, 1.0, 2.0, 0.2, 1.1, 1.5),
                 {KnotVector::uniform(2, 2), KnotVector::uniform(2, 3), KnotVector::uniform(2, 2)});
}

TEST(Tessellation, FieldsInSpaceEqualTheirRationalSums) {
  const Patch<3> tube = tubePart();
  const ModelRecord model = modelOf(tube);
  const Eigen::MatrixXd q = randomCoefficients(2, model.mesh.numNodes, 11);
  const Eigen::MatrixXd values = Tessellation(model.mesh, 2).evaluate(q);
  const auto at = [&](int d) { return subdividedSpans(tube.basis().direction(d), 2); };
  Eigen::Index i = 0;
  for (const double c : at(2))
    for (const double b : at(1))
      for (const double a : at(0)) {
        const Eigen::Vector3d xi(a, b, c);
        const int span = tube.findSpan(xi);
        const Eigen::VectorXd expected =
            q(Eigen::all, tube.basis().spanFunctions(span)) * tube.shape(span, xi).R;
        ASSERT_LT((values.col(i++) - expected).norm(), 1e-14);
      }
  EXPECT_EQ(i, values.cols());
}

/// Volume inside a closed surface whose quadrilaterals go round counterclockwise seen from outside.
double volume(vtkPolyData& surface) {
  double sum = 0.0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < surface.GetNumberOfCells(); ++cell) {
    surface.GetCellPoints(cell, ids);
    const auto x = [&](vtkIdType k) { return pointOf(surface, ids->GetId(k)); };
    sum += x(0).dot((x(2) - x(0)).cross(x(3) - x(1))) / 6.0;
  }
  return sum;
}

TEST(BodySurface, OfAPlaneBodyHasThePointsAndCellsOfTheTessellation) {
  const ModelRecord model = modelOf(quarterRing());
  const Tessellation mesh(model.mesh, 3);
  const FrameRecord frame = frameOf(model, 0, 0.0);
  const auto surface = BodySurface(model.mesh, 3).displaced(frame.displacement);
  ASSERT_EQ(surface->GetNumberOfPoints(), mesh.numPoints());
  ASSERT_EQ(surface->GetNumberOfCells(), mesh.numCells());
  const Eigen::MatrixXd x = mesh.referencePoints() + mesh.evaluate(frame.displacement);
  for (int i = 0; i < mesh.numPoints(); ++i)
    EXPECT_LT((pointOf(*surface, i).head<2>() - x.col(i)).norm(), 1e-14);
  vtkNew<vtkIdList> ids;
  for (int cell = 0; cell < mesh.numCells(); ++cell) {
    surface->GetCellPoints(cell, ids);
    for (int c = 0; c < 4; ++c) EXPECT_EQ(ids->GetId(c), mesh.cells()(c, cell));
  }
  EXPECT_EQ(surface->GetPointData()->GetNormals(), nullptr);
}

TEST(BodySurface, InSpaceIsClosedAndItsFacesLookOutwards) {
  const Patch<3> block =
      refined(box({1.0, 2.0, 3.0}, {2.0, 3.0, 1.0}),
              {KnotVector::uniform(1, 2), KnotVector::uniform(2, 3), KnotVector::uniform(1, 1)});
  const auto surface = BodySurface(modelOf(block).mesh, 2).displaced({});
  EXPECT_EQ(surface->GetNumberOfCells(), 2 * (4 * 6 + 6 * 2 + 2 * 4));
  EXPECT_NEAR(volume(*surface), 6.0, 1e-12);
}

TEST(BodySurface, NormalsOfATubeAreRadialAndItsEdgesSharp) {
  const auto surface = BodySurface(modelOf(tubePart()).mesh, 20).displaced({});
  int outside = 0;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i) {
    const Eigen::Vector3d normal(surface->GetPointData()->GetNormals()->GetTuple3(i));
    const Eigen::Vector3d radial = Eigen::Vector3d(pointOf(*surface, i).x(), pointOf(*surface, i).y(), 0.0);
    EXPECT_NEAR(normal.norm(), 1.0, 1e-14);
    if (radial.norm() < 2.0 - 1e-12 || normal.dot(radial) < 1.0) continue;
    ++outside;
    EXPECT_LT((normal - radial / 2.0).norm(), 1e-12);
  }
  EXPECT_EQ(outside, 61 * 41);
}

TEST(BodySurface, NormalsGoWithTheDeformation) {
  const ModelRecord model = modelOf(tubePart());
  Eigen::Matrix3d F;
  F << 1.2, 0.3, 0.0, -0.1, 0.8, 0.2, 0.4, 0.0, 1.1;
  Eigen::MatrixXd displacement(3, model.mesh.numNodes);
  for (const PatchRecord& patch : model.mesh.patches)
    displacement(Eigen::all, patch.nodes) = (F - Eigen::Matrix3d::Identity()) * patch.points;
  const BodySurface surface(model.mesh, 3);
  const auto before = surface.displaced({}), after = surface.displaced(displacement);
  for (vtkIdType i = 0; i < before->GetNumberOfPoints(); ++i) {
    const Eigen::Vector3d N(before->GetPointData()->GetNormals()->GetTuple3(i));
    const Eigen::Vector3d n(after->GetPointData()->GetNormals()->GetTuple3(i));
    EXPECT_LT((n - (F.inverse().transpose() * N).normalized()).norm(), 1e-12);
  }
}

/// Where an edge of a patch has shrunk to a point, and at creases between linear spans.
TEST(BodySurface, HasNormalsWhereTangentsHaveNone) {
  const KnotVector knots = KnotVector::uniform(1, 2);
  ModelRecord model = modelOf(refined(box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}), {knots, knots, knots}));
  PatchRecord& patch = model.mesh.patches.front();
  // A prism of which the edge x = y = 1 is that of y = 0 too, with a roof over its middle x = 1/2.
  for (Eigen::Index k = 0; k < patch.points.cols(); ++k) {
    const double x = patch.points(0, k);
    patch.points(1, k) *= 1.0 - x;
    if (patch.points(2, k) == 1.0) patch.points(2, k) += 0.5 - std::abs(x - 0.5);
  }
  const auto surface = BodySurface(model.mesh, 1).displaced({});
  int atTip = 0, onRidge = 0;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i) {
    const Eigen::Vector3d normal(surface->GetPointData()->GetNormals()->GetTuple3(i));
    const Eigen::Vector3d x = pointOf(*surface, i);
    if (normal.z() < 0.5) continue;
    if (x.x() == 1.0) {
      ++atTip;
      EXPECT_LT((normal - Eigen::Vector3d(1.0, 0.0, 1.0).normalized()).norm(), 1e-5);
    } else if (x.x() == 0.5) {
      ++onRidge;
      EXPECT_LT((normal - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
    }
  }
  EXPECT_EQ(atTip, 3);
  EXPECT_EQ(onRidge, 3);
}

/// A single cell along a direction has one middle along it.
TEST(BodySurface, HasNormalsInTheMiddlesOfSingleCells) {
  const ModelRecord model = modelOf(box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}));
  const auto surface =
      BodySurface(model.mesh, 1, BodySurface::Faces::Outside, BodySurface::Cells::TrianglesAboutMiddles)
          .displaced({});
  ASSERT_EQ(surface->GetNumberOfPoints(), 6 * 5);
  int middles = 0;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i) {
    const Eigen::Vector3d normal(surface->GetPointData()->GetNormals()->GetTuple3(i));
    const Eigen::Vector3d out = pointOf(*surface, i) - Eigen::Vector3d::Constant(0.5);
    EXPECT_NEAR(normal.dot(out), 0.5, 1e-12);
    EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
    if (std::abs(out.norm() - 0.5) > 1e-12) continue;
    ++middles;
    EXPECT_LT((normal - 2.0 * out).norm(), 1e-12);
  }
  EXPECT_EQ(middles, 6);
}

TEST(BodySurface, OfJoinedPatchesHasNoFacesInside) {
  const KnotVector knots = KnotVector::uniform(2, 2);
  const Patch<3> block = refined(box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}), {knots, knots, knots});
  const FrameRecord frame = frameOf(modelOf(block), 0, 0.0);
  FrameRecord still = frame;
  still.displacement.setZero();
  const ModelFrame whole = mirrored(modelOf(block), still, {{0, 1.0}, {1, 0.0}});
  ASSERT_EQ(whole.model.mesh.patches.size(), 4U);
  const auto surface = BodySurface(whole.model.mesh, 1).displaced({});
  EXPECT_EQ(surface->GetNumberOfCells(), 4 * 4 * 4);  // of 24 faces 8 lie inside
  EXPECT_NEAR(volume(*surface), 4.0, 1e-12);
  EXPECT_EQ(bodyOutline(whole.model.mesh, {}, 1)->GetNumberOfLines(), 4 * 4 + 4);
}

TEST(Mirror, ImageHasTheFieldsOfTheOriginal) {
  ModelRecord model = modelOf(quarterRing());
  model.tools = {{"plate", Plane{{0.0, 5.0, 0.0}, {0.6, -0.8, 0.0}}},
                 {"disc", Cylinder{{0.0, 4.0, 0.0}, {0.0, 0.0, 1.0}, 1.0}, {0.0, 4.0, 0.0}}};
  FrameRecord frame = frameOf(model, 0, 0.0);
  const Eigen::RowVectorXd x = model.mesh.patches.front().points.row(0);
  frame.displacement.row(0) = 0.1 * x;  // nothing on the plane
  frame.fields["stress"] = {{"xx", "yy", "xy", "zz"}, "", randomCoefficients(4, model.mesh.numNodes, 3)};
  frame.fields["stress"].values.row(2).array() *= x.array();  // nothing on the plane either
  frame.toolDisplacement = Eigen::Matrix2d{{0.0, 0.0}, {-0.5, -0.25}};
  frame.toolAngle = Eigen::Vector2d(0.0, 0.3);
  const ModelFrame whole = mirrored(model, frame, {{0, 0.0}});

  const Tessellation mesh(whole.model.mesh, 4);
  const int half = mesh.numPoints() / 2;
  EXPECT_EQ(mesh.numPoints(), 2 * half);
  EXPECT_GT(area(mesh), 0.0);  // of every cell
  const Eigen::MatrixXd& X = mesh.referencePoints();
  const Eigen::MatrixXd u = mesh.evaluate(whole.frame.displacement),
                        stress = mesh.evaluate(whole.frame.fields.at("stress").values);
  const int row = 4 * quarterRing().basis().direction(0).numSpans() + 1;
  for (int i = 0; i < half; ++i) {
    const int other = half + i - i % row + row - 1 - i % row;
    EXPECT_LT((X.col(other) - Eigen::Vector2d(-X(0, i), X(1, i))).norm(), 1e-13);
    EXPECT_LT((u.col(other) - Eigen::Vector2d(-u(0, i), u(1, i))).norm(), 1e-13);
    EXPECT_NEAR(stress(0, other), stress(0, i), 1e-13);
    EXPECT_NEAR(stress(2, other), -stress(2, i), 1e-13);
  }

  ASSERT_EQ(whole.model.tools.size(), 3U);  // the disc is its own image
  const auto& plate = std::get<Plane>(whole.model.tools[2].shape);
  EXPECT_LT((plate.normal - Eigen::Vector3d(-0.6, -0.8, 0.0)).norm(), 1e-14);
  EXPECT_EQ(whole.frame.toolDisplacement.col(2), Eigen::Vector2d(0.0, -0.5));
  EXPECT_NO_THROW(checkModel(whole.model, "mirrored"));
}

TEST(Mirror, AxisOfAHollowBodyOfRevolution) {
  ModelRecord tube = modelOf(quarterRing());
  tube.mesh.patches.front().points.row(0).array() += 0.5;
  FrameRecord frame = frameOf(tube, 0, 0.0);
  frame.displacement.setZero();
  EXPECT_THROW(mirrored(tube, frame, {{0, 0.0}}), Error) << "a plane body";
  tube.sceneYaml = "title: \"tube\"\nkinematics: axisymmetric\n";
  const ModelFrame whole = mirrored(tube, frame, {{0, 0.0}});
  EXPECT_EQ(whole.model.mesh.patches.size(), 2U);
  EXPECT_EQ(whole.model.mesh.numNodes, 2 * tube.mesh.numNodes);
  EXPECT_EQ(whole.model.mesh.patches[1].points.row(0).minCoeff(),
            -tube.mesh.patches[0].points.row(0).maxCoeff());
  EXPECT_THROW(mirrored(tube, frame, {{0, 0.25}}), Error);
}

TEST(Mirror, ShowsABodyThatWasMeshedAnewWhole) {
  const ModelRecord model = modelOf(quarterRing()), other = modelOf(ringOf({2, 5}));
  FrameRecord frame = frameOf(other, 1, 1.0);
  frame.mesh = other.mesh;
  frame.displacement.row(0) = 0.1 * other.mesh.patches.front().points.row(0);
  const ModelFrame whole = mirrored(model, frame, {{0, 0.0}});
  EXPECT_NO_THROW(checkModel(whole.model, "mirrored"));
  EXPECT_NO_THROW(checkFrame(whole.frame, whole.model, "mirrored"));
  EXPECT_EQ(whole.model.mesh.numNodes, 2 * 5 * 6 - 5);
  EXPECT_EQ(meshOf(whole.model, whole.frame).numNodes, 2 * 4 * 7 - 4);
  for (const MeshRecord* mesh : {&whole.model.mesh, &meshOf(whole.model, whole.frame)}) {
    EXPECT_EQ(bodyOutline(*mesh, {}, 1)->GetNumberOfLines(), 6);  // none on the plane
    EXPECT_GT(area(Tessellation(*mesh, 4)), 0.0);
  }
  frame.displacement.row(0).array() += 0.1;
  EXPECT_THROW(mirrored(model, frame, {{0, 0.0}}), Error);
}

TEST(Mirror, AToolThatHasLeftThePlaneIsDrawnTwice) {
  ModelRecord model = modelOf(quarterRing());
  model.tools = {{"disc", Cylinder{{0.0, 4.0, 0.0}, {0.0, 0.0, 1.0}, 1.0}}};
  FrameRecord frame = frameOf(model, 0, 0.0);
  frame.displacement.row(0) = 0.1 * model.mesh.patches.front().points.row(0);
  frame.toolDisplacement = Eigen::Vector2d(0.0, -0.5);
  EXPECT_EQ(mirrored(model, frame, {{0, 0.0}}).model.tools.size(), 1U);
  frame.toolDisplacement(0, 0) = 0.25;
  const ModelFrame whole = mirrored(model, frame, {{0, 0.0}});
  ASSERT_EQ(whole.model.tools.size(), 2U);
  EXPECT_EQ(whole.frame.toolDisplacement.col(1), Eigen::Vector2d(-0.25, -0.5));
}

TEST(PlaneSection, OfABallIsACircleWithItsArea) {
  const auto ball = toolOutline({"ball", Sphere{{1.0, 2.0, 3.0}, 2.0}}, 3, {});
  const CutPlane plane{{1.0, 2.0, 4.0}, {0.0, 0.0, 3.0}};
  const auto circle = sectionOf(*ball, plane);
  for (vtkIdType i = 0; i < circle->GetNumberOfPoints(); ++i) {
    EXPECT_NEAR(pointOf(*circle, i).z(), 4.0, 1e-12);
    EXPECT_NEAR((pointOf(*circle, i) - Eigen::Vector3d(1.0, 2.0, 4.0)).norm(), std::sqrt(3.0), 5e-3);
  }
  const auto disc = enclosedAreas(*circle);
  double sum = 0.0;
  for (vtkIdType k = 0; k < disc->GetNumberOfCells(); ++k)
    sum += vtkTriangle::SafeDownCast(disc->GetCell(k))->ComputeArea();
  EXPECT_NEAR(sum, 3.0 * std::numbers::pi, 0.02 * sum);
  const auto below = behind(*ball, plane);
  EXPECT_NEAR(below->GetBounds()[5], 4.0, 1e-9);
  EXPECT_NEAR(below->GetBounds()[4], 1.0, 1e-12);
}

TEST(BodySurface, RefusesWhatDoesNotFit) {
  const ModelRecord model = modelOf(quarterRing());
  EXPECT_THROW(BodySurface(model.mesh, 0), Error);
  EXPECT_THROW(BodySurface(model.mesh, 2).displaced(Eigen::MatrixXd::Zero(3, model.mesh.numNodes)), Error);
  EXPECT_THROW(BodySurface(model.mesh, 2).evaluate(Eigen::MatrixXd::Zero(1, model.mesh.numNodes + 1)), Error);
}

TEST(FieldRange, OfABodyInSpaceIncludesItsInside) {
  const ModelRecord model = modelOf(tubePart());
  FrameRecord frame = frameOf(model, 0, 0.0);
  Eigen::MatrixXd& pressure = frame.fields["pressure"].values;
  pressure.setZero();
  pressure(0, 1 + 4 * (2 + 5 * 1)) = 3.0;  // a function that vanishes on all faces
  for (const std::string field : {"pressure", "plastic_strain"}) {
    const Eigen::MatrixXd values = Tessellation(model.mesh, 24).evaluate(frame.fields[field].values);
    const double smallest = field == "plastic_strain" ? 0.0 : values.minCoeff();
    EXPECT_THAT(fieldRange(model, frame, field, 3),
                testing::ElementsAre(testing::DoubleNear(smallest, 2e-3),
                                     testing::DoubleNear(values.maxCoeff(), 2e-3)));
  }
  EXPECT_GT(fieldRange(model, frame, "pressure", 3)[1], 0.5);
  EXPECT_EQ(BodySurface(model.mesh, 3).evaluate(pressure).cwiseAbs().maxCoeff(), 0.0);
}

TEST(Outlines, OfARingAreFourLinesOnItsEdges) {
  const auto outline = bodyOutline(modelOf(quarterRing()).mesh, {}, 4);
  ASSERT_EQ(outline->GetNumberOfLines(), 4);
  EXPECT_EQ(outline->GetPoints()->GetDataType(), VTK_DOUBLE);
  for (vtkIdType i = 0; i < outline->GetNumberOfPoints(); ++i) {
    const Eigen::Vector3d x = pointOf(*outline, i);
    const double off = std::min({std::abs(x.norm() - kInnerRadius), std::abs(x.norm() - kOuterRadius),
                                 std::abs(x.x()), std::abs(x.y())});
    EXPECT_LT(off, 1e-13);
  }
}

TEST(Outlines, KnotLinesAreTheInteriorOnes) {
  const auto lines = knotLines(modelOf(quarterRing()).mesh, {}, 4);
  EXPECT_EQ(lines->GetNumberOfLines(), 2 + 3);
  EXPECT_EQ(lines->GetNumberOfPoints(), 2 * 17 + 3 * 13);
}

TEST(Outlines, FollowTheDisplacement) {
  const Patch<2> ring = lagrangeRing();
  const ModelRecord model = modelOf(ring);
  const Eigen::Vector2d shift(0.3, -0.2);
  const auto still = knotLines(model.mesh, {}, 3);
  const auto moved = knotLines(model.mesh, shift.replicate(1, model.mesh.numNodes), 3);
  for (vtkIdType i = 0; i < still->GetNumberOfPoints(); ++i)
    EXPECT_LT((pointOf(*moved, i) - pointOf(*still, i) - Eigen::Vector3d(0.3, -0.2, 0.0)).norm(), 1e-14);
}

TEST(Outlines, OfABlockLieOnItsSurface) {
  const Patch<3> block =
      refined(box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}),
              {KnotVector::uniform(1, 2), KnotVector::uniform(1, 3), KnotVector::uniform(1, 1)});
  EXPECT_EQ(bodyOutline(modelOf(block).mesh, {}, 1)->GetNumberOfLines(), 12);
  const auto lines = knotLines(modelOf(block).mesh, {}, 1);
  EXPECT_EQ(lines->GetNumberOfLines(), 4 + 2 + 6);
  for (vtkIdType i = 0; i < lines->GetNumberOfPoints(); ++i) {
    const Eigen::Array3d x = pointOf(*lines, i);
    EXPECT_EQ((x * (1.0 - x)).minCoeff(), 0.0);
  }
}

/// A model of patches that share the nodes of control points at the same place.
template <int Dim>
ModelRecord joinedModel(const std::vector<Patch<Dim>>& patches) {
  std::vector<std::string> names;
  for (std::size_t p = 0; p < patches.size(); ++p) names.push_back(std::to_string(p));
  const Body<Dim> body = joinedBody<Dim>(patches, names);
  ModelRecord model;
  model.dim = Dim;
  model.mesh.numNodes = body.numNodes;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    model.mesh.patches.push_back(recordOf(patches[p]));
    model.mesh.patches.back().nodes = body.nodes[p];
  }
  return model;
}

TEST(Outlines, FacesThatTwoPatchesShareAreSeams) {
  const ModelRecord model = joinedModel<2>({rectangle({0, 0}, {1, 1}), rectangle({1, 0}, {2, 1})});
  EXPECT_EQ(bodyOutline(model.mesh, {}, 1)->GetNumberOfLines(), 6);
  const auto seam = knotLines(model.mesh, {}, 1);
  ASSERT_EQ(seam->GetNumberOfLines(), 1);
  for (vtkIdType i = 0; i < seam->GetNumberOfPoints(); ++i) EXPECT_EQ(pointOf(*seam, i).x(), 1.0);
}

TEST(Outlines, ARingClosedToItselfHasTwoEdges) {
  ModelRecord model = modelOf(quarterRing());
  PatchRecord& patch = model.mesh.patches[0];
  const auto radial = static_cast<std::size_t>(basisOf(patch.directions[0]).numFunctions());
  for (std::size_t a = 0; a < radial; ++a) patch.nodes[patch.nodes.size() - radial + a] = patch.nodes[a];
  EXPECT_EQ(bodyOutline(model.mesh, {}, 1)->GetNumberOfLines(), 2);
  EXPECT_EQ(knotLines(model.mesh, {}, 1)->GetNumberOfLines(), 2 + 3 + 1);
}

TEST(Outlines, TwoBoxesHaveTheEdgesOfOneAndFourSeams) {
  const ModelRecord model = joinedModel<3>({box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {1, 1, 1})});
  EXPECT_EQ(bodyOutline(model.mesh, {}, 1)->GetNumberOfLines(), 8 + 2 * 4);
  EXPECT_EQ(knotLines(model.mesh, {}, 1)->GetNumberOfLines(), 4);
}

TEST(Outlines, AnLOfThreeBoxesHasTheEdgeInItsCorner) {
  const ModelRecord model =
      joinedModel<3>({box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {1, 1, 1}), box({0, 1, 0}, {1, 1, 1})});
  const auto outline = bodyOutline(model.mesh, {}, 1);
  int inCorner = 0;
  for (vtkIdType k = 0; k < outline->GetNumberOfCells(); ++k) {
    const double* b = outline->GetCell(k)->GetBounds();
    inCorner += b[0] == 1.0 && b[1] == 1.0 && b[2] == 1.0 && b[3] == 1.0;
  }
  EXPECT_EQ(inCorner, 1);
}

const Eigen::AlignedBox3d kBox(Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(4.0, 2.0, 0.0));

TEST(ToolOutline, OfACylinderIsAClosedCircle) {
  const ToolRecord tool{"roller", Cylinder{{1.0, 2.0, 0.0}, Eigen::Vector3d::UnitZ(), 0.7}};
  const auto circle = toolOutline(movedTool(tool, {0.5, -0.25, 0.0}, 0.0), 2, kBox);
  ASSERT_EQ(circle->GetNumberOfLines(), 1);
  EXPECT_GE(circle->GetNumberOfPoints(), 256);
  for (vtkIdType i = 0; i < circle->GetNumberOfPoints(); ++i)
    EXPECT_NEAR((pointOf(*circle, i) - Eigen::Vector3d(1.5, 1.75, 0.0)).norm(), 0.7, 1e-14);
  vtkNew<vtkIdList> ids;
  circle->GetCellPoints(0, ids);
  EXPECT_EQ(ids->GetNumberOfIds(), circle->GetNumberOfPoints() + 1);
  EXPECT_EQ(ids->GetId(0), ids->GetId(ids->GetNumberOfIds() - 1));
}

TEST(ToolOutline, OfAPlanePassesTheWholeBox) {
  const ToolRecord tool{"table", Plane{{100.0, -1.0, 0.0}, {0.0, 2.0, 0.0}}};
  const auto segment = toolOutline(movedTool(tool, {0.0, 0.25, 0.0}, 0.0), 2, kBox);
  ASSERT_EQ(segment->GetNumberOfPoints(), 2);
  const Eigen::Vector3d a = pointOf(*segment, 0), b = pointOf(*segment, 1);
  EXPECT_NEAR(a.y(), -0.75, 1e-14);
  EXPECT_NEAR(b.y(), -0.75, 1e-14);
  EXPECT_LT(std::min(a.x(), b.x()), 0.0);
  EXPECT_GT(std::max(a.x(), b.x()), 4.0);
}

double gapTo(const RecordedShape& shape, const Eigen::Vector3d& x) {
  struct Gap {
    const Eigen::Vector3d& x;
    double operator()(const Plane& plane) const { return plane.query(x).gap; }
    double operator()(const Cylinder& cylinder) const { return cylinder.query(x).gap; }
    double operator()(const Sphere& sphere) const { return sphere.query(x).gap; }
    double operator()(const SurfaceMesh&) const { return HUGE_VAL; }
  };
  return std::visit(Gap{x}, shape);
}

TEST(ToolOutline, InSpaceLiesOnTheTool) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(4.0, 2.0, 3.0));
  const Eigen::Vector3d shift(0.1, 0.2, 0.3);
  const std::vector<RecordedShape> shapes{Plane{{0.0, -1.0, 0.0}, {1.0, 2.0, 0.5}},
                                          Cylinder{{1.0, 3.0, 0.0}, {1.0, 0.0, 2.0}, 0.8},
                                          Sphere{{1.0, 3.0, 1.0}, 0.6}};
  for (const RecordedShape& shape : shapes) {
    const auto surface = toolOutline(movedTool({"tool", shape}, shift, 0.0), 3, box);
    EXPECT_GT(surface->GetNumberOfPolys(), 0);
    for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
      EXPECT_NEAR(gapTo(shape, pointOf(*surface, i) - shift), 0.0, 1e-13);
  }
}

TEST(ToolOutline, OfATurnedMeshKeepsItsDistanceFromTheAxis) {
  SurfaceMesh mesh{Eigen::Matrix3Xd::Random(3, 3), Eigen::MatrixXi{{0, 1}, {1, 2}}, false};
  mesh.points.row(2).setZero();
  ToolRecord tool{"key", mesh};
  tool.pivot = {0.2, 0.3, 0.0};
  const auto lines = toolOutline(movedTool(tool, {1.0, 2.0, 0.0}, std::numbers::pi / 2), 2, kBox);
  ASSERT_EQ(lines->GetNumberOfLines(), 2);
  for (vtkIdType i = 0; i < 3; ++i) {
    const Eigen::Vector3d before = mesh.points.col(i) - tool.pivot;
    const Eigen::Vector3d after = pointOf(*lines, i) - tool.pivot - Eigen::Vector3d(1.0, 2.0, 0.0);
    EXPECT_NEAR((after - Eigen::Vector3d(-before.y(), before.x(), 0.0)).norm(), 0.0, 1e-14);
  }
}

/// Of half a ball the rim is left of the edges: none where parts of its flat face meet, to which a face has shrunk.
TEST(Mirror, LeavesNoEdgesWhereCollapsedFacesMeet) {
  const KnotVector knots = KnotVector::uniform(2, 2);
  const Patch<3> octant = refined(ballOctant({0, 0, 0}, 1.0, {0, 1, 0}), {knots, knots, knots});
  const ModelRecord model = joinedModel<3>({octant});
  FrameRecord still;
  still.displacement = Eigen::MatrixXd::Zero(3, model.mesh.numNodes);
  still.toolDisplacement = Eigen::MatrixXd::Zero(3, 0);
  const ModelFrame half = mirrored(model, still, {{0, 0.0}, {1, 0.0}});
  const auto outline = bodyOutline(half.model.mesh, {}, 4);
  EXPECT_EQ(outline->GetNumberOfLines(), 4);
  for (vtkIdType k = 0; k < outline->GetNumberOfPoints(); ++k) {
    EXPECT_NEAR(pointOf(*outline, k).norm(), 1.0, 1e-12);
    EXPECT_EQ(pointOf(*outline, k).z(), 0.0);
  }
}

}  // namespace
}  // namespace burnish
