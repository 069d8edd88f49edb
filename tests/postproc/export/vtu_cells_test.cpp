#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "postproc/export/vtu_series_writer.h"
#include "postproc/mesh/patch_geometry.h"
#include "tests/engine/analysis/model_samples.h"
#include "tests/postproc/export/vtu_files.h"

/// Curved cells, written, read back with VTK and evaluated by VTK, against the patches themselves.
namespace burnish {
namespace {

using namespace samples;
using VtuCells = test::VtuFiles;

constexpr double kQuarter = std::numbers::pi / 2.0;

/// Largest distances between the two over random points of all cells.
struct Distance {
  double geometry = 0.0, displacement = 0.0, stress = 0.0;
};

Eigen::VectorXd interpolated(vtkCell& cell, vtkDataArray& array, const std::vector<double>& shape) {
  Eigen::VectorXd value = Eigen::VectorXd::Zero(array.GetNumberOfComponents());
  for (vtkIdType a = 0; a < cell.GetNumberOfPoints(); ++a)
    for (Eigen::Index c = 0; c < value.size(); ++c)
      value(c) += shape[static_cast<std::size_t>(a)] *
                  array.GetComponent(cell.GetPointId(static_cast<int>(a)), static_cast<int>(c));
  return value;
}

/// Compares one cell, which is a knot span of the patch, at some points.
template <int Dim>
void compareCell(vtkUnstructuredGrid& grid, vtkIdType number, const PatchRecord& record, int span,
                 const FrameRecord& frame, Distance& distance) {
  static std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Patch<Dim> patch = patchGeometry<Dim>(record, frame.displacement);
  const auto functions = patch.basis().spanFunctions(span);
  std::vector<int> nodes;
  for (const int a : functions) nodes.push_back(record.nodes[static_cast<std::size_t>(a)]);
  vtkCell& cell = *grid.GetCell(number);
  for (int k = 0; k < 5; ++k) {
    double parameters[3] = {uniform(generator), uniform(generator), Dim == 3 ? uniform(generator) : 0.0};
    typename Patch<Dim>::Parameter xi;
    for (int d = 0; d < Dim; ++d) {
      const UnivariateBasis& basis = patch.basis().direction(d);
      const int e = patch.basis().spanIndex(span)[static_cast<std::size_t>(d)];
      xi(d) = std::lerp(basis.spanBegin(e), basis.spanEnd(e), parameters[d]);
    }
    const Eigen::VectorXd R = patch.shape(span, xi).R;
    Eigen::Vector3d x;
    std::vector<double> shape(static_cast<std::size_t>(cell.GetNumberOfPoints()));
    int subId = 0;
    cell.EvaluateLocation(subId, parameters, x.data(), shape.data());
    const auto far = [](double& largest, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
      largest = std::max(largest, (a - b).norm());
    };
    far(distance.geometry, x.head<Dim>(), patch.points()(Eigen::all, functions) * R);
    const auto at = [&](const char* name) -> Eigen::VectorXd {
      return interpolated(cell, *grid.GetPointData()->GetArray(name), shape);
    };
    far(distance.displacement, at("displacement").topRows(Dim), frame.displacement(Eigen::all, nodes) * R);
    far(distance.stress, at("stress [MPa]"), frame.fields.at("stress").values(Eigen::all, nodes) * R);
  }
}

Distance distanceFrom(const ModelRecord& model, const FrameRecord& frame, vtkUnstructuredGrid& grid) {
  Distance distance;
  vtkIdType cell = 0;
  for (std::size_t p = 0; p < model.mesh.patches.size(); ++p) {
    int numSpans = 1;
    for (const DirectionRecord& direction : model.mesh.patches[p].directions)
      numSpans *=
          static_cast<int>(std::set<double>(direction.knots.begin(), direction.knots.end()).size()) - 1;
    for (int span = 0; span < numSpans; ++span, ++cell) {
      EXPECT_EQ(grid.GetCellData()->GetArray("patch")->GetComponent(cell, 0), p);
      const auto compare = model.dim == 2 ? compareCell<2> : compareCell<3>;
      compare(grid, cell, model.mesh.patches[p], span, frame, distance);
    }
  }
  EXPECT_EQ(grid.GetNumberOfCells(), cell);
  return distance;
}

void expectExact(const Distance& distance, double tolerance = 1e-12) {
  EXPECT_LT(distance.geometry, tolerance);
  EXPECT_LT(distance.displacement, tolerance);
  EXPECT_LT(distance.stress, tolerance);
}

/// Two squares of degree 2 side by side that disagree on the weights of their common edge.
ModelRecord quarrellingSquares() {
  const auto square = [](double x) {
    return refined(rectangle({x, 0.0}, {1.0, 1.0}), {KnotVector::uniform(2, 1), KnotVector::uniform(2, 2)});
  };
  ModelRecord model = modelOf(square(0.0));
  PatchRecord right = recordOf(square(1.0));
  for (std::size_t a = 0; a < right.nodes.size(); ++a)
    right.nodes[a] = a % 3 == 0 ? static_cast<int>(a) + 2 : model.mesh.numNodes++;
  right.weights(3) = 0.3;
  model.mesh.patches.push_back(right);
  return model;
}

class CurvedCellsRoundTrip : public VtuCells {
 protected:
  vtkSmartPointer<vtkUnstructuredGrid> roundTrip(const ModelRecord& model, const FrameRecord& frame,
                                                 CellKind cells) {
    VtuSeriesWriter(directory_, model, {.cells = cells, .parts = {ExportPart::Body}}).write(frame);
    return readGrid("body_000000.vtu");
  }

  Distance distance(const ModelRecord& model, CellKind cells) {
    const FrameRecord frame = frameOf(model, 0, 0.0);
    return distanceFrom(model, frame, *roundTrip(model, frame, cells));
  }
};

TEST_F(CurvedCellsRoundTrip, BezierQuadrilateralsAreTheNurbsThemselves) {
  expectExact(distance(modelOf(quarterRing()), CellKind::Bezier));
  EXPECT_EQ(readGrid("body_000000.vtu")->GetCellType(0), VTK_BEZIER_QUADRILATERAL);
}

TEST_F(CurvedCellsRoundTrip, BezierCellsHaveADegreePerDirection) {
  const Patch<2> ring = refined(annulus({0.0, 0.0}, 1.0, 2.0, 0.2, 1.1),
                                {KnotVector(4, {0, 0, 0, 0, 0, 0.4, 0.4, 1, 1, 1, 1, 1}),
                                 KnotVector(3, {0, 0, 0, 0, 0.5, 0.7, 0.7, 0.7, 1, 1, 1, 1})});
  expectExact(distance(modelOf(ring), CellKind::Bezier));
}

TEST_F(CurvedCellsRoundTrip, BezierCellsTakeLagrangeElementsToo) {
  expectExact(distance(modelOf(lagrangeRing()), CellKind::Bezier));
}

TEST_F(CurvedCellsRoundTrip, BezierHexahedraAreTheNurbsThemselves) {
  const Patch<3> tube =
      refined(cylinderSegment({0.0, 0.0, 0.0}, 1.0, 2.0, 0.0, kQuarter, 1.5),
              {KnotVector::uniform(2, 2), KnotVector::uniform(4, 2), KnotVector::uniform(3, 3)});
  expectExact(distance(modelOf(tube), CellKind::Bezier));
  EXPECT_EQ(readGrid("body_000000.vtu")->GetCellType(0), VTK_BEZIER_HEXAHEDRON);
  const Patch<3> shell =
      refined(sphereSegment({1.0, 0.0, 0.0}, 1.0, 2.0, {0.0, kQuarter}, {-0.3, 0.8}),
              {KnotVector::uniform(3, 1), KnotVector::uniform(3, 2), KnotVector::uniform(3, 2)});
  expectExact(distance(modelOf(shell), CellKind::Bezier));
}

TEST_F(CurvedCellsRoundTrip, PatchesKeepTheirOwnWeights) {
  expectExact(distance(quarrellingSquares(), CellKind::Bezier));
}

TEST_F(CurvedCellsRoundTrip, CellsOfOnePatchShareTheirPoints) {
  const ModelRecord model = modelOf(quarterRing());
  for (const CellKind cells : {CellKind::Bezier, CellKind::Lagrange})
    EXPECT_EQ(roundTrip(model, frameOf(model, 0, 0.0), cells)->GetNumberOfPoints(), 7 * 9);
}

TEST_F(CurvedCellsRoundTrip, LagrangeCellsAreExactForPolynomials) {
  expectExact(distance(modelOf(lagrangeRing()), CellKind::Lagrange));
  EXPECT_EQ(readGrid("body_000000.vtu")->GetCellType(0), VTK_LAGRANGE_QUADRILATERAL);
  const Patch<3> block =
      refined(box({0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}),
              {KnotVector::uniform(2, 2), KnotVector::uniform(4, 1), KnotVector::uniform(3, 2)});
  expectExact(distance(modelOf(block), CellKind::Lagrange));
  EXPECT_EQ(readGrid("body_000000.vtu")->GetCellType(0), VTK_LAGRANGE_HEXAHEDRON);
}

TEST_F(CurvedCellsRoundTrip, LagrangeCellsInterpolateRationalFunctions) {
  const ModelRecord model = modelOf(quarterRing());
  FrameRecord frame = frameOf(model, 0, 0.0);
  frame.displacement.setZero();
  const Distance distance = distanceFrom(model, frame, *roundTrip(model, frame, CellKind::Lagrange));
  EXPECT_GT(distance.geometry, 1e-6) << "an arc is not a parabola";
  EXPECT_LT(distance.geometry, 5e-3);
}

TEST_F(CurvedCellsRoundTrip, DegreesGoUpToTen) {
  const auto square = [](int degree) {
    return modelOf(refined(rectangle({0.0, 0.0}, {1.0, 2.0}),
                           {KnotVector::uniform(degree, 2), KnotVector::uniform(degree, 1)}));
  };
  for (const CellKind cells : {CellKind::Bezier, CellKind::Lagrange}) {
    expectExact(distance(square(10), cells));
    try {
      const VtuSeriesWriter writer(directory_, square(11), {.cells = cells});
      FAIL() << "VTK has no cells of degree 11";
    } catch (const Error& error) {
      EXPECT_STREQ(
          error.what(),
          "found a patch of degree 11; Lagrange and Bezier cells have degrees up to 10; linear cells "
          "take every degree");
    }
    EXPECT_TRUE(std::filesystem::exists(directory_ / "frames.pvd")) << "the earlier series is still there";
  }
  EXPECT_NO_THROW(VtuSeriesWriter(directory_, square(11)));
}

}  // namespace
}  // namespace burnish
