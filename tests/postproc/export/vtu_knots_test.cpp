#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellType.h>
#include <vtkPointData.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "postproc/export/vtu_series_writer.h"
#include "tests/postproc/export/vtu_files.h"
#include "tests/postproc/sample_records.h"

namespace burnish {
namespace {

class VtuKnots : public test::VtuFiles {
 protected:
  vtkSmartPointer<vtkUnstructuredGrid> knots(const samples::Sample& sample, const VtuOptions& options) {
    VtuSeriesWriter(directory_, sample.model, options).write(sample.frame);
    return readGrid("knots_000000.vtu");
  }

  /// Distance of a place of a line from the middle of the ring.
  static double radius(vtkCell& line, double parameter) {
    const double parameters[3]{parameter, 0.0, 0.0};
    Eigen::Vector3d x;
    std::vector<double> weights(static_cast<std::size_t>(line.GetNumberOfPoints()));
    int subId = 0;
    line.EvaluateLocation(subId, parameters, x.data(), weights.data());
    return x.norm();
  }
};

TEST_F(VtuKnots, AreTheLinesBetweenSpans) {
  samples::Sample ring = samples::ring({4, 6});
  ring.model.subdivision = 3;
  const auto lines = knots(ring, {.parts = {ExportPart::Knots}});
  ASSERT_EQ(lines->GetNumberOfCells(), 5 + 7);
  EXPECT_EQ(lines->GetNumberOfPoints(), 5 * 19 + 7 * 13 - 5 * 7);  // crossings once
  vtkDataArray* stress = lines->GetPointData()->GetArray("von_mises [MPa]");
  ASSERT_NE(stress, nullptr);
  int around = 0;
  for (vtkIdType k = 0; k < lines->GetNumberOfCells(); ++k) {
    vtkCell* line = lines->GetCell(k);
    EXPECT_EQ(line->GetCellType(), VTK_POLY_LINE);
    around += line->GetNumberOfPoints() == 19 ? 1 : 0;
    EXPECT_TRUE(line->GetNumberOfPoints() == 19 || line->GetNumberOfPoints() == 13);
  }
  EXPECT_EQ(around, 5);
  for (vtkIdType k = 0; k < lines->GetNumberOfPoints(); ++k)
    EXPECT_NEAR(stress->GetTuple1(k), 100.0 * (Eigen::Map<Eigen::Vector3d>(lines->GetPoint(k)).norm() - 1.0),
                1e-10);
}

TEST_F(VtuKnots, AreExactAsBezierCurves) {
  const auto lines = knots(samples::ring({4, 6}),
                           {.cells = CellKind::Bezier, .parts = {ExportPart::Body, ExportPart::Knots}});
  ASSERT_EQ(lines->GetNumberOfCells(), 5 * 6 + 7 * 4);
  int around = 0;
  for (vtkIdType k = 0; k < lines->GetNumberOfCells(); ++k) {
    vtkCell* line = lines->GetCell(k);
    ASSERT_EQ(line->GetCellType(), VTK_BEZIER_CURVE);
    const double begin = radius(*line, 0.0), end = radius(*line, 1.0);
    if (std::abs(end - begin) > 1e-9) continue;
    ++around;
    for (const double parameter : {0.1, 0.3, 0.5, 0.9}) EXPECT_NEAR(radius(*line, parameter), begin, 1e-14);
  }
  EXPECT_EQ(around, 5 * 6);
}

TEST_F(VtuKnots, OfVolumesLieOnTheirFaces) {
  for (const CellKind cells : {CellKind::Linear, CellKind::Lagrange}) {
    const auto lines = knots(samples::cube(3), {.cells = cells, .parts = {ExportPart::Knots}});
    ASSERT_EQ(lines->GetNumberOfCells(), 3 * (4 * 4 - 2 * 2));
    for (vtkIdType k = 0; k < lines->GetNumberOfPoints(); ++k) {
      const Eigen::Map<Eigen::Vector3d> x(lines->GetPoint(k));
      EXPECT_LT((x.array() * (1.0 - x.array())).abs().minCoeff(), 1e-14) << x.transpose();
    }
  }
}

TEST_F(VtuKnots, OfSeveralBodiesAreParts) {
  const samples::Sample sample = samples::twoBodies();
  VtuSeriesWriter(directory_, sample.model, {.parts = {ExportPart::Knots}, .pieces = 2}).write(sample.frame);
  EXPECT_THAT(filesIn(directory_ / "frames"),
              testing::ElementsAre("all_000000.vtm", "knots_block_000000.vtu", "knots_stamp_000000.vtu"));
}

}  // namespace
}  // namespace burnish
