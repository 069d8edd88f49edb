#include "postproc/draw/foreign/linear_parts.h"

#include <gtest/gtest.h>
#include <vtkBezierHexahedron.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "postproc/draw/foreign/foreign_percentiles.h"
#include "postproc/draw/foreign/foreign_surface.h"
#include "postproc/mesh/plane_section.h"

/// Parts of curved cells have the places and the values of these.
namespace burnish {
namespace {

using Grid = vtkSmartPointer<vtkUnstructuredGrid>;
using Function = std::function<double(const Eigen::Vector3d&)>;

constexpr double kEverywhere = std::numeric_limits<double>::infinity();

/// Adds a cell whose points lie where a map takes the parameters of those of a kind.
void addCell(vtkUnstructuredGrid& grid, int type, int kind,
             const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map) {
  if (!grid.GetPoints()) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    grid.SetPoints(points);
  }
  vtkNew<vtkGenericCell> cell;
  cell->SetCellType(kind);
  std::vector<vtkIdType> ids;
  for (vtkIdType k = 0; k < cell->GetNumberOfPoints(); ++k)
    ids.push_back(grid.GetPoints()->InsertNextPoint(
        map(Eigen::Map<const Eigen::Vector3d>(cell->GetParametricCoords() + 3 * k)).eval().data()));
  grid.InsertNextCell(type, std::ssize(ids), ids.data());
}

void setDrawn(vtkUnstructuredGrid& grid, const Function& function) {
  vtkNew<vtkDoubleArray> drawn;
  drawn->SetName("drawn");
  for (vtkIdType k = 0; k < grid.GetNumberOfPoints(); ++k)
    drawn->InsertNextValue(function(Eigen::Map<const Eigen::Vector3d>(grid.GetPoint(k))));
  grid.GetPointData()->AddArray(drawn);
}

Grid allParts(vtkUnstructuredGrid& grid) {
  return linearParts(grid, Eigen::VectorXd::Zero(grid.GetNumberOfPoints()), {-kEverywhere, kEverywhere});
}

double largestError(vtkPointSet& grid, const Function& exact) {
  vtkDataArray& drawn = *grid.GetPointData()->GetArray("drawn");
  double error = 0.0;
  for (vtkIdType k = 0; k < grid.GetNumberOfPoints(); ++k)
    error = std::max(error, std::abs(drawn.GetComponent(k, 0) -
                                     exact(Eigen::Map<const Eigen::Vector3d>(grid.GetPoint(k)))));
  return error;
}

/// The areas of all faces or the volumes of all cells.
double sizeOf(vtkDataSet& cells) {
  double size = 0.0;
  vtkNew<vtkIdList> ids;
  vtkNew<vtkPoints> corners;
  for (vtkIdType cell = 0; cell < cells.GetNumberOfCells(); ++cell) {
    cells.GetCell(cell)->Triangulate(0, ids, corners);
    const bool isVolume = cells.GetCell(cell)->GetCellDimension() == 3;
    for (vtkIdType k = 0; k < corners->GetNumberOfPoints(); k += isVolume ? 4 : 3) {
      const auto corner = [&](vtkIdType c) { return Eigen::Vector3d(corners->GetPoint(k + c)); };
      const Eigen::Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
      size += isVolume ? std::abs(normal.dot(corner(3) - corner(0))) / 6.0 : 0.5 * normal.norm();
    }
  }
  return size;
}

/// Whether the first corners lie as those of the parameters do.
bool isRightHanded(vtkCell& cell) {
  const std::array<Eigen::Index, 4> corners = [&]() -> std::array<Eigen::Index, 4> {
    if (cell.GetCellType() == VTK_TETRA || cell.GetCellType() == VTK_WEDGE) return {0, 1, 2, 3};
    if (cell.GetCellType() == VTK_PYRAMID || cell.GetCellType() == VTK_HEXAHEDRON) return {0, 1, 3, 4};
    return {0, 1, cell.GetNumberOfPoints() - 1, -1};
  }();
  Eigen::Matrix3d edges = Eigen::Matrix3d::Identity();
  for (std::size_t k = 1; k < corners.size() && corners[k] > 0; ++k)
    edges.col(static_cast<Eigen::Index>(k) - 1) = Eigen::Vector3d(cell.GetPoints()->GetPoint(corners[k])) -
                                                  Eigen::Vector3d(cell.GetPoints()->GetPoint(0));
  return edges.determinant() > 0.0;
}

struct Kind {
  int type;
  int ordered;  ///< a kind with its points in the same order
  double size;  ///< of the cell in its own parameters
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      {VTK_QUADRATIC_QUAD, VTK_QUADRATIC_QUAD, 1.0},
      {VTK_BIQUADRATIC_QUAD, VTK_BIQUADRATIC_QUAD, 1.0},
      {VTK_QUADRATIC_LINEAR_QUAD, VTK_QUADRATIC_LINEAR_QUAD, 1.0},
      {VTK_QUADRATIC_TRIANGLE, VTK_QUADRATIC_TRIANGLE, 0.5},
      {VTK_BIQUADRATIC_TRIANGLE, VTK_BIQUADRATIC_TRIANGLE, 0.5},
      {VTK_QUADRATIC_TETRA, VTK_QUADRATIC_TETRA, 1.0 / 6.0},
      {VTK_QUADRATIC_PYRAMID, VTK_QUADRATIC_PYRAMID, 1.0 / 3.0},
      {VTK_TRIQUADRATIC_PYRAMID, VTK_TRIQUADRATIC_PYRAMID, 1.0 / 3.0},
      {VTK_QUADRATIC_WEDGE, VTK_QUADRATIC_WEDGE, 0.5},
      {VTK_QUADRATIC_LINEAR_WEDGE, VTK_QUADRATIC_LINEAR_WEDGE, 0.5},
      {VTK_BIQUADRATIC_QUADRATIC_WEDGE, VTK_BIQUADRATIC_QUADRATIC_WEDGE, 0.5},
      {VTK_QUADRATIC_HEXAHEDRON, VTK_QUADRATIC_HEXAHEDRON, 1.0},
      {VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, 1.0},
      {VTK_TRIQUADRATIC_HEXAHEDRON, VTK_TRIQUADRATIC_HEXAHEDRON, 1.0},
      {VTK_LAGRANGE_QUADRILATERAL, VTK_BIQUADRATIC_QUAD, 1.0},
      {VTK_LAGRANGE_TRIANGLE, VTK_QUADRATIC_TRIANGLE, 0.5},
      {VTK_LAGRANGE_TETRAHEDRON, VTK_QUADRATIC_TETRA, 1.0 / 6.0},
      {VTK_BEZIER_QUADRILATERAL, VTK_BIQUADRATIC_QUAD, 1.0},
      {VTK_BEZIER_TRIANGLE, VTK_QUADRATIC_TRIANGLE, 0.5},
      {VTK_BEZIER_TETRAHEDRON, VTK_QUADRATIC_TETRA, 1.0 / 6.0}};
  return all;
}

TEST(LinearParts, FillEveryKindOfCell) {
  const auto linear = [](const Eigen::Vector3d& x) { return 3.0 + 2.0 * x(0) - x(1) + 5.0 * x(2); };
  for (const auto& [type, ordered, size] : kinds()) {
    const auto grid = Grid::New();
    addCell(*grid, type, ordered, [type = type](const Eigen::Vector3d& p) -> Eigen::Vector3d {
      if (type != VTK_QUADRATIC_PYRAMID) return p;
      const double width = 1.0 - p(2);  // one face of its cube of parameters is the apex
      return {0.5 + width * (p(0) - 0.5), 0.5 + width * (p(1) - 0.5), p(2)};
    });
    setDrawn(*grid, linear);
    ASSERT_TRUE(hasCurved(*grid)) << type;
    const Grid parts = allParts(*grid);
    EXPECT_FALSE(hasCurved(*parts));
    EXPECT_LT(
        largestError(*parts, [](const Eigen::Vector3d& x) { return 3.0 + 2.0 * x(0) - x(1) + 5.0 * x(2); }),
        1e-12)
        << type;
    EXPECT_NEAR(sizeOf(*parts), size, 1e-12) << type;
    EXPECT_NEAR(sizesIn(*parts, false).sum(), size, 1e-12) << type;
    EXPECT_NEAR(sizesIn(*parts, true).sum(), size, 1e-12) << type;
    for (vtkIdType part = 0; part < parts->GetNumberOfCells(); ++part)
      EXPECT_TRUE(isRightHanded(*parts->GetCell(part))) << type << " " << part;
  }
}

/// A quarter of a ring between the radii 1 and 2, of height 1.
Grid ringGrid(int type) {
  constexpr int kRound = 4, kOut = 2;
  const auto apart = Grid::New();
  for (int j = 0; j < kRound; ++j)
    for (int i = 0; i < kOut; ++i)
      addCell(*apart, type, type, [&](const Eigen::Vector3d& p) {
        const double radius = 1.0 + (i + p(0)) / kOut, angle = 0.5 * std::numbers::pi * (j + p(1)) / kRound;
        return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), p(2));
      });
  setDrawn(*apart, [](const Eigen::Vector3d& x) { return x.z() * x.z(); });
  return shownCells({apart});
}

TEST(LinearParts, OfCellsThatMeetShareTheirPoints) {
  const Grid ring = ringGrid(VTK_QUADRATIC_HEXAHEDRON), parts = allParts(*ring);
  const int n = 1 << kCurvedParts;
  EXPECT_EQ(parts->GetNumberOfPoints(), (2 * n + 1) * (4 * n + 1) * (n + 1));
  EXPECT_EQ(outerFaces(*parts)->GetNumberOfCells(), 2 * (2 * n * 4 * n + 2 * n * n + 4 * n * n));
  vtkIdType edges = 0;  // those of the curved cells alone
  const auto lines = cellEdges(*outerFaces(*parts));
  for (vtkIdType k = 0; k < lines->GetNumberOfCells(); ++k)
    edges += lines->GetCell(k)->GetNumberOfPoints() - 1;
  EXPECT_GT(edges, 0);
  EXPECT_LE(edges, 48 * n);
}

TEST(LinearParts, SectionOfARingHasItsAreaAndValues) {
  for (const int type : {VTK_QUADRATIC_HEXAHEDRON, VTK_TRIQUADRATIC_HEXAHEDRON}) {
    const Grid ring = ringGrid(type);
    const auto section = sectionOf(*allParts(*ring), {{0.0, 0.0, 0.25}, {0.0, 0.0, 1.0}});
    EXPECT_NEAR(sizeOf(*section), 0.75 * std::numbers::pi, 2e-3);
    EXPECT_LT(largestError(*section, [](const Eigen::Vector3d& x) { return x.z() * x.z(); }), 1e-12);
  }
}

TEST(LinearParts, CellsOutOfReachAreLeftOut) {
  const Grid ring = ringGrid(VTK_QUADRATIC_HEXAHEDRON);
  Eigen::VectorXd abscissas(ring->GetNumberOfPoints());
  for (vtkIdType k = 0; k < abscissas.size(); ++k) abscissas(k) = ring->GetPoint(k)[0];
  const CutPlane plane{{1.9, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  const Grid near = linearParts(*ring, abscissas, {1.9, 1.9});
  EXPECT_LT(near->GetNumberOfCells(), allParts(*ring)->GetNumberOfCells());
  EXPECT_NEAR(sizeOf(*sectionOf(*near, plane)), std::sqrt(4.0 - 1.9 * 1.9), 3e-3);
}

/// Nothing of a mirror's plane is seen.
TEST(CurvedCells, MeetTheirImages) {
  for (const int type : {VTK_QUADRATIC_HEXAHEDRON, VTK_TRIQUADRATIC_HEXAHEDRON}) {
    const Grid ring = ringGrid(type);
    const auto whole = outerFaces(*shownCells({ring, mirroredCells(*ring, {0, 0.0}, 1.0)}));
    int inPlane = 0;
    for (vtkIdType face = 0; face < whole->GetNumberOfCells(); ++face) {
      const double* bounds = whole->GetCell(face)->GetBounds();
      if (std::max(-bounds[0], bounds[1]) < 1e-9) ++inPlane;
    }
    EXPECT_EQ(inPlane, 0) << type;
  }
}

/// A triangle between three corners of a face is a part of it if the face is straight.
TEST(ShownCells, LeaveOutPartsOfStraightFaces) {
  for (const int type : {VTK_HEXAHEDRON, VTK_QUADRATIC_HEXAHEDRON}) {
    const Grid grid = Grid::New();
    addCell(*grid, type, type, [](const Eigen::Vector3d& p) { return p; });
    const std::array<vtkIdType, 3> corners{0, 1, 2};
    grid->InsertNextCell(VTK_TRIANGLE, 3, corners.data());
    EXPECT_EQ(shownCells({grid})->GetNumberOfCells(), type == VTK_HEXAHEDRON ? 1 : 2);
  }
}

/// Whatever the order of corners is.
TEST(OuterFaces, LookAwayFromTheirVolumes) {
  for (const int type : {VTK_HEXAHEDRON, VTK_WEDGE, VTK_TETRA, VTK_PYRAMID, VTK_QUADRATIC_HEXAHEDRON,
                         VTK_QUADRATIC_WEDGE, VTK_QUADRATIC_TETRA, VTK_TRIQUADRATIC_HEXAHEDRON})
    for (const bool isInverted : {false, true}) {
      const Grid grid = Grid::New();
      addCell(*grid, type, type, [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
        return {isInverted ? 1.0 - p(0) : p(0), p(1), p(2)};
      });
      Eigen::Vector3d middle = Eigen::Vector3d::Zero();
      for (vtkIdType k = 0; k < grid->GetNumberOfPoints(); ++k)
        middle += Eigen::Vector3d(grid->GetPoint(k)) / static_cast<double>(grid->GetNumberOfPoints());
      const auto faces = outerFaces(*grid);
      EXPECT_GE(faces->GetNumberOfCells(), 4);
      for (vtkIdType face = 0; face < faces->GetNumberOfCells(); ++face) {
        vtkPoints& corners = *faces->GetCell(face)->GetPoints();
        const Eigen::Vector3d first(corners.GetPoint(0)), second(corners.GetPoint(1)),
            third(corners.GetPoint(2));
        EXPECT_GT((second - first).cross(third - first).dot(first - middle), 0.0) << type << " " << face;
      }
    }
}

/// Four cells go round a thin tube: the middle of their corners is within its bore.
TEST(OuterFaces, OfBentCellsLookAwayFromThem) {
  constexpr int kOut = 2, kRound = 4, kLayers = 3;
  const Grid tube = Grid::New();
  for (int layer = 0; layer < kLayers; ++layer)
    for (int j = 0; j < kRound; ++j)
      for (int i = 0; i < kOut; ++i)
        addCell(*tube, VTK_QUADRATIC_HEXAHEDRON, VTK_QUADRATIC_HEXAHEDRON, [&](const Eigen::Vector3d& p) {
          const double radius = 1.0 + 0.1 * (i + p(0)) / kOut,
                       angle = 2.0 * std::numbers::pi * (j + p(1)) / kRound;
          return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), layer + p(2));
        });
  const auto faces = outerFaces(*shownCells({tube}));
  int inBore = 0;
  for (vtkIdType face = 0; face < faces->GetNumberOfCells(); ++face) {
    vtkPoints& corners = *faces->GetCell(face)->GetPoints();
    const Eigen::Vector3d first(corners.GetPoint(0)), second(corners.GetPoint(1)), third(corners.GetPoint(2));
    const Eigen::Vector3d normal = (second - first).cross(third - first).normalized(),
                          place = (first + second + third) / 3.0,
                          fromAxis = Eigen::Vector3d(place.x(), place.y(), 0.0).normalized();
    if (std::abs(normal.z()) > 0.5) {
      EXPECT_GT(normal.z() * (place.z() - 0.5 * kLayers), 0.0);
      continue;
    }
    const bool isInBore = place.head<2>().norm() < 1.02;
    inBore += isInBore ? 1 : 0;
    EXPECT_GT((isInBore ? -1.0 : 1.0) * normal.dot(fromAxis), 0.0) << place.transpose();
  }
  EXPECT_GT(inBore, 100);
}

/// Coordinates far from the origin have digits enough for what is there, but not in single precision.
TEST(CurvedCells, HaveTheSameFacesFarFromTheOrigin) {
  const Eigen::Vector3d far = std::ldexp(1.0, 20) * Eigen::Vector3d(1.0, 2.0, -3.0);
  const Grid ring = ringGrid(VTK_QUADRATIC_HEXAHEDRON), moved = Grid::New();
  moved->DeepCopy(ring);
  for (vtkIdType k = 0; k < ring->GetNumberOfPoints(); ++k) {
    Eigen::Vector3d place(ring->GetPoint(k));
    for (double& x : place) x = std::ldexp(std::round(std::ldexp(x, 20)), -20);  // so that the sums are exact
    ring->GetPoints()->SetPoint(k, place.data());
    moved->GetPoints()->SetPoint(k, (place + far).eval().data());
  }
  const auto here = outerFaces(*ring), there = outerFaces(*moved);
  ASSERT_EQ(there->GetNumberOfCells(), here->GetNumberOfCells());
  ASSERT_EQ(there->GetNumberOfPoints(), here->GetNumberOfPoints());
  for (vtkIdType k = 0; k < here->GetNumberOfPoints(); ++k)
    EXPECT_LT((Eigen::Vector3d(there->GetPoint(k)) - far - Eigen::Vector3d(here->GetPoint(k))).norm(), 1e-8)
        << k;
}

/// What stands at the points of rational cells are coefficients: the field of these is the radius.
TEST(LinearParts, HaveTheValuesOfRationalCells) {
  const auto grid = Grid::New();
  constexpr std::array<int, 4> kOrder{2, 2, 2, 27};
  std::array<Eigen::Vector4d, 27> corners;  // with the field
  std::array<double, 27> weights{};
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const auto at =
            static_cast<std::size_t>(vtkBezierHexahedron::PointIndexFromIJK(i, j, k, kOrder.data()));
        const double radius = 1.0 + 0.5 * i;
        corners[at] = {j < 2 ? radius : 0.0, j > 0 ? radius : 0.0, 0.5 * k, radius};
        weights[at] = j == 1 ? std::numbers::sqrt2 / 2.0 : 1.0;
      }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> drawn, shares, degrees;
  drawn->SetName("drawn");
  shares->SetName("weights");
  degrees->SetName("degrees");
  degrees->SetNumberOfComponents(3);
  degrees->InsertNextTuple3(2, 2, 2);
  std::vector<vtkIdType> ids;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    ids.push_back(points->InsertNextPoint(corners[k].data()));
    drawn->InsertNextValue(corners[k](3));
    shares->InsertNextValue(weights[k]);
  }
  grid->SetPoints(points);
  grid->InsertNextCell(VTK_BEZIER_HEXAHEDRON, std::ssize(ids), ids.data());
  grid->GetPointData()->AddArray(drawn);
  grid->GetPointData()->SetRationalWeights(shares);
  grid->GetCellData()->SetHigherOrderDegrees(degrees);
  const Grid parts = allParts(*grid);
  EXPECT_LT(largestError(*parts, [](const Eigen::Vector3d& x) { return std::hypot(x(0), x(1)); }), 1e-12);
  const auto section = sectionOf(*parts, {{0.0, 0.0, 0.3}, {0.0, 0.0, 1.0}});
  EXPECT_NEAR(sizeOf(*section), 0.75 * std::numbers::pi, 0.02);
  EXPECT_LT(largestError(*section, [](const Eigen::Vector3d& x) { return std::hypot(x(0), x(1)); }), 0.01);
}

/// The vector (2s - 1, 0, 0) has the length 1 at both ends of a cell, and 0 in the middle.
TEST(LinearParts, LengthsAreThoseOfTheVectorsBetween) {
  const auto grid = Grid::New();
  addCell(*grid, VTK_QUADRATIC_HEXAHEDRON, VTK_QUADRATIC_HEXAHEDRON,
          [](const Eigen::Vector3d& place) { return place; });
  setDrawn(*grid, [](const Eigen::Vector3d& x) { return std::abs(2.0 * x(0) - 1.0); });
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("drawn_vector");
  vectors->SetNumberOfComponents(3);
  for (vtkIdType k = 0; k < grid->GetNumberOfPoints(); ++k)
    vectors->InsertNextTuple3(2.0 * grid->GetPoint(k)[0] - 1.0, 0.0, 0.0);
  grid->GetPointData()->AddArray(vectors);
  const auto length = [](const Eigen::Vector3d& x) { return std::abs(2.0 * x(0) - 1.0); };
  EXPECT_LT(largestError(*allParts(*grid), length), 1e-12);
  EXPECT_LT(largestError(*outerFaces(*grid), length), 1e-6);
  EXPECT_EQ(outerFaces(*grid)->GetPointData()->GetArray("drawn_vector"), nullptr);
}

}  // namespace
}  // namespace burnish
