#include "postproc/draw/contour/streamlines.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStreamTracer.h>

#include <array>
#include <cmath>

#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

using Line = Eigen::Matrix3Xd;

constexpr double kStep = 0.2;          // of lines, in distances between them
constexpr double kCloserAtEnds = 0.5;  // how near lines may come, in distances

/// The ways from a seed, first along the vectors, then against them; begin at the seed.
using Ways = std::array<Line, 2>;

/// The surface with unit vectors where they are not slow, in the plane z = 0.
vtkSmartPointer<vtkPolyData> flattened(vtkPolyData& surface, const Eigen::Matrix3d& toPlane) {
  constexpr double kSlowest = 0.01;
  vtkDataArray& vectors = *surface.GetPointData()->GetArray("vectors");
  const vtkIdType count = surface.GetNumberOfPoints();
  Eigen::Matrix3Xd x(3, count), along(3, count);
  for (vtkIdType k = 0; k < count; ++k) {
    x.col(k) = toPlane * Eigen::Map<const Eigen::Vector3d>(surface.GetPoint(k));
    along.col(k) = toPlane * Eigen::Map<const Eigen::Vector3d>(vectors.GetTuple3(k));
  }
  x.row(2).setZero();
  along.row(2).setZero();
  const double largest = along.colwise().norm().maxCoeff();
  if (largest == 0.0) return nullptr;
  for (Eigen::Index k = 0; k < along.cols(); ++k)
    if (along.col(k).norm() < kSlowest * largest) along.col(k).setZero();
  const auto flat = vtkSmartPointer<vtkPolyData>::New();
  flat->SetPoints(makePoints(x));
  flat->SetPolys(surface.GetPolys());
  flat->GetPointData()->SetVectors(makeArray("along", along / largest, {}));
  return flat;
}

/// The ways from all seeds, in the plane.
std::vector<Ways> traced(vtkPolyData& flat, const Eigen::Matrix3Xd& seeds, double distance) {
  vtkNew<vtkPolyData> begins;
  begins->SetPoints(makePoints(seeds));
  vtkNew<vtkStreamTracer> tracer;
  tracer->SetInputData(&flat);
  tracer->SetSourceData(begins);
  tracer->SetInterpolatorTypeToCellLocator();
  tracer->SetIntegratorTypeToRungeKutta4();
  tracer->SetIntegrationStepUnit(vtkStreamTracer::LENGTH_UNIT);
  tracer->SetInitialIntegrationStep(kStep * distance);
  tracer->SetMaximumPropagation(3.0 * flat.GetLength());
  tracer->SetMaximumNumberOfSteps(std::lround(3.0 * flat.GetLength() / (kStep * distance)));
  tracer->SetIntegrationDirectionToBoth();
  tracer->SetComputeVorticity(false);
  tracer->Update();

  std::vector<Ways> ways(static_cast<std::size_t>(seeds.cols()));
  vtkPolyData& found = *tracer->GetOutput();
  vtkDataArray* ofSeeds = found.GetCellData()->GetArray("SeedIds");
  vtkDataArray* along = found.GetPointData()->GetArray("along");
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < found.GetNumberOfLines(); ++cell) {
    found.GetLines()->GetCellAtId(cell, ids);
    if (ids->GetNumberOfIds() < 2) continue;
    Line line(3, ids->GetNumberOfIds());
    double with = 0.0;
    for (Eigen::Index k = 0; k < line.cols(); ++k) {
      line.col(k) = Eigen::Map<const Eigen::Vector3d>(found.GetPoint(ids->GetId(k)));
      if (k > 0)
        with += Eigen::Map<const Eigen::Vector3d>(along->GetTuple3(ids->GetId(k)))
                    .dot(line.col(k) - line.col(k - 1));
    }
    ways[static_cast<std::size_t>(ofSeeds->GetTuple1(cell))][with > 0.0 ? 0 : 1] = line;
  }
  return ways;
}

/// Whether one of some points (3 x points) is nearer than a distance.
template <class Points>
bool areNear(const Points& points, const Eigen::Vector3d& point, double distance) {
  return points.cols() > 0 &&
         (points.colwise() - point).colwise().squaredNorm().minCoeff() < distance * distance;
}

/// The part of a way before it comes too near to lines before, back to where it was, or to the other way from its seed,
/// as it does round a loop. drawn: points of those lines.
Line freePart(const Line& way, const Line& other, const Line& drawn, double distance) {
  const double near = kCloserAtEnds * distance;
  const auto lag = std::lround(2.0 / kStep);  // points that are so few steps apart may be near
  Eigen::Index count = 0;
  for (; count < way.cols(); ++count) {
    const Eigen::Vector3d point = way.col(count);
    if (areNear(drawn, point, near)) break;
    if (count > lag && areNear(way.leftCols(count - lag), point, near)) break;
    if (other.cols() > lag && areNear(other.rightCols(other.cols() - lag), point, near)) break;
  }
  return way.leftCols(count);
}

double lengthOf(const Line& line) {
  const Eigen::Index pieces = line.cols() - 1;
  return pieces < 1 ? 0.0 : (line.rightCols(pieces) - line.leftCols(pieces)).colwise().norm().sum();
}

}  // namespace

std::vector<Eigen::Matrix3Xd> evenStreamlines(vtkPolyData& surface, const Eigen::Vector3d& normal,
                                              const std::vector<Eigen::Vector3d>& seeds, double distance) {
  if (surface.GetNumberOfPoints() == 0 || seeds.empty()) return {};
  Eigen::Matrix3d toPlane;
  toPlane.row(2) = normal.normalized();
  toPlane.row(0) = normal.unitOrthogonal();
  toPlane.row(1) = toPlane.row(2).cross(toPlane.row(0));
  const auto flat = flattened(surface, toPlane);
  if (!flat) return {};
  Eigen::Matrix3Xd begins(3, static_cast<Eigen::Index>(seeds.size()));
  for (Eigen::Index k = 0; k < begins.cols(); ++k)
    begins.col(k) = toPlane * seeds[static_cast<std::size_t>(k)];
  const double depth = begins(2, 0);
  begins.row(2).setZero();

  std::vector<Line> lines;
  Line drawn(3, 0);
  const std::vector<Ways> allWays = traced(*flat, begins, distance);
  for (std::size_t k = 0; k < allWays.size(); ++k) {
    const auto& [with, against] = allWays[k];
    if (areNear(drawn, begins.col(static_cast<Eigen::Index>(k)), distance)) continue;
    const Line after = freePart(with, {}, drawn, distance),
               before = freePart(against, after, drawn, distance);
    Line line(3, before.cols() + std::max<Eigen::Index>(after.cols() - 1, 0));
    line << before.rowwise().reverse(), after.rightCols(line.cols() - before.cols());
    if (before.cols() == 0) line = after;
    if (lengthOf(line) < distance) continue;
    drawn.conservativeResize(3, drawn.cols() + line.cols());
    drawn.rightCols(line.cols()) = line;
    line.row(2).setConstant(depth);
    lines.emplace_back(toPlane.transpose() * line);
  }
  return lines;
}

}  // namespace burnish
