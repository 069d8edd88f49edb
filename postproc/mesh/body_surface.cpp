#include "postproc/mesh/body_surface.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <array>
#include <numeric>
#include <utility>

#include "engine/results/check_records.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

/// Unit normals at the points: those of the cells around, weighted by their areas. Zero where all of them have
/// shrunk to a line. corners: of quadrilaterals or triangles.
Eigen::Matrix3Xd normalsOf(const Eigen::Matrix3Xd& x, const Eigen::Map<const Eigen::MatrixXi>& corners) {
  Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Zero(3, x.cols());
  const Eigen::Index last = corners.rows() - 1;  // of a triangle the diagonals are two sides
  for (const auto& cell : corners.colwise()) {
    const Eigen::Vector3d diagonal1 = x.col(cell(2)) - x.col(cell(0)),
                          diagonal2 = x.col(cell(last)) - x.col(cell(1));
    const Eigen::Vector3d normal = diagonal1.cross(diagonal2);
    for (const int point : cell) normals.col(point) += normal;
  }
  normals.colwise().normalize();
  return normals;
}

/// The points of a patch whose parameters are all combinations of these, given per direction.
TensorPoints pointsAt(const PatchRecord& patch, const std::vector<std::vector<double>>& parameters) {
  std::vector<PointRow> directions;
  for (std::size_t d = 0; d < parameters.size(); ++d)
    directions.push_back(valuesAt(basisOf(patch.directions[d]), parameters[d]));
  return {patch, std::move(directions)};
}

/// The parameters in the middles between these; one alone stays.
std::vector<std::vector<double>> middlesOf(std::vector<std::vector<double>> parameters) {
  for (std::vector<double>& row : parameters) {
    for (std::size_t k = 0; k + 1 < row.size(); ++k) row[k] = std::midpoint(row[k], row[k + 1]);
    if (row.size() > 1) row.pop_back();
  }
  return parameters;
}

}  // namespace

BodySurface::BodySurface(const MeshRecord& mesh, const Subdivision& subdivision, Faces faces, Cells cells)
    : points_(mesh.numNodes), kind_(cells) {
  checkMesh(mesh, mesh.dim(), "mesh");
  if (faces == Faces::OfSpans) {
    for (std::size_t patch = 0; patch < mesh.patches.size(); ++patch)
      addFacesOfSpans(mesh, patch, subdivision);
  } else {
    const PatchBorders borders(mesh);
    for (const PatchSide& side : borders.surface()) addSide(mesh, side, subdivision);
  }
  cells_ = makeCells(cornersOfCells());
}

void BodySurface::addSide(const MeshRecord& mesh, const PatchSide& side, const Subdivision& subdivision) {
  const PatchRecord& patch = mesh.patches[side.patch];
  std::vector<std::vector<double>> parameters;
  bool clockwise = false;
  for (std::size_t d = 0; d < side.ends.size(); ++d) {
    const UnivariateBasis basis = basisOf(patch.directions[d]);
    const bool atEnd = side.ends[d] == PatchSide::End::End;
    if (side.ends[d] == PatchSide::End::None) {
      parameters.push_back(subdivision.parameters(side.patch, d, basis));
      continue;
    }
    parameters.push_back({atEnd ? basis.breakpoints().back() : basis.breakpoints().front()});
    // Rows and columns of the second direction's faces are the first and the third direction, whose cross
    // product points backwards.
    clockwise = atEnd == (d == 1);
  }
  add(patch, parameters, clockwise);
}

void BodySurface::addFacesOfSpans(const MeshRecord& mesh, std::size_t number,
                                  const Subdivision& subdivision) {
  const PatchRecord& patch = mesh.patches[number];
  std::vector<std::vector<double>> parameters;
  for (std::size_t d = 0; d < patch.directions.size(); ++d)
    parameters.push_back(subdivision.parameters(number, d, basisOf(patch.directions[d])));
  for (std::size_t d = 0; d < parameters.size(); ++d) {
    const UnivariateBasis basis = basisOf(patch.directions[d]);
    for (const double breakpoint : basis.breakpoints()) {
      std::vector<std::vector<double>> face = parameters;
      face[d] = {breakpoint};
      add(patch, face, false);
    }
  }
}

void BodySurface::add(const PatchRecord& patch, const std::vector<std::vector<double>>& parameters,
                      bool clockwise) {
  const bool aboutMiddles = kind_ == Cells::TrianglesAboutMiddles;
  TensorPoints points = pointsAt(patch, parameters);
  std::vector<int> extent;
  for (const int n : points.box().extent)
    if (n > 1) extent.push_back(n);
  const int first = points_.size(), row = extent[0];
  int middle = first + points.size();
  for (int j = 0; j + 1 < extent[1]; ++j)
    for (int i = 0; i + 1 < row; ++i) {
      const int corner = first + j * row + i;
      const std::array quad{corner, corner + (clockwise ? row : 1), corner + row + 1,
                            corner + (clockwise ? 1 : row)};
      if (aboutMiddles) {
        for (std::size_t k = 0; k < 4; ++k)
          corners_.insert(corners_.end(), {quad[k], quad[(k + 1) % 4], middle});
        ++middle;
      } else {
        corners_.insert(corners_.end(), quad.begin(), quad.end());
      }
    }
  points_.add(std::move(points));
  if (aboutMiddles) points_.add(pointsAt(patch, middlesOf(parameters)));
}

Eigen::Map<const Eigen::MatrixXi> BodySurface::cornersOfCells() const {
  const Eigen::Index perCell = kind_ == Cells::TrianglesAboutMiddles ? 3 : 4;
  return {corners_.data(), perCell, std::ssize(corners_) / perCell};
}

vtkSmartPointer<vtkPolyData> BodySurface::displaced(const Eigen::MatrixXd& displacement) const {
  const Eigen::MatrixXd x = points_.positions(displacement);
  const auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(makePoints(x));
  surface->SetPolys(cells_);
  if (x.rows() == 3)
    surface->GetPointData()->SetNormals(makeArray("normals", normalsOf(x, cornersOfCells()), {}));
  return surface;
}

}  // namespace burnish
