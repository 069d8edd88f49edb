#include "postproc/mesh/body_surface.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <utility>

#include "engine/results/check_records.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

using Corners = Eigen::Matrix<int, 4, Eigen::Dynamic>;

/// Unit normals at the points: those of the quadrilaterals around, weighted by their areas. Zero where all of
/// them have shrunk to a line.
Eigen::Matrix3Xd normalsOf(const Eigen::Matrix3Xd& x, const Eigen::Map<const Corners>& corners) {
  Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Zero(3, x.cols());
  for (const auto& quad : corners.colwise()) {
    const Eigen::Vector3d diagonal1 = x.col(quad(2)) - x.col(quad(0)),
                          diagonal2 = x.col(quad(3)) - x.col(quad(1));
    const Eigen::Vector3d normal = diagonal1.cross(diagonal2);
    for (const int point : quad) normals.col(point) += normal;
  }
  normals.colwise().normalize();
  return normals;
}

}  // namespace

BodySurface::BodySurface(const MeshRecord& mesh, int subdivision, Faces faces) : points_(mesh.numNodes) {
  checkMesh(mesh, mesh.dim(), "mesh");
  if (faces == Faces::OfSpans) {
    for (const PatchRecord& patch : mesh.patches) addFacesOfSpans(patch, subdivision);
  } else {
    const PatchBorders borders(mesh);
    for (const PatchSide& side : borders.surface()) addSide(mesh.patches[side.patch], side.ends, subdivision);
  }
  cells_ = makeCells(Eigen::Map<const Corners>(corners_.data(), 4, std::ssize(corners_) / 4));
}

void BodySurface::addSide(const PatchRecord& patch, const std::vector<PatchSide::End>& ends,
                          int subdivision) {
  std::vector<PointRow> directions;
  bool clockwise = false;
  for (std::size_t d = 0; d < ends.size(); ++d) {
    const UnivariateBasis basis = basisOf(patch.directions[d]);
    const bool atEnd = ends[d] == PatchSide::End::End;
    if (ends[d] == PatchSide::End::None) {
      directions.push_back(valuesAt(basis, subdividedSpans(basis, subdivision)));
      continue;
    }
    directions.push_back(valuesAt(basis, {atEnd ? basis.breakpoints().back() : basis.breakpoints().front()}));
    // Rows and columns of the second direction's faces are the first and the third direction, whose cross
    // product points backwards.
    clockwise = atEnd == (d == 1);
  }
  add(TensorPoints(patch, std::move(directions)), clockwise);
}

void BodySurface::addFacesOfSpans(const PatchRecord& patch, int subdivision) {
  std::vector<PointRow> directions;
  for (const DirectionRecord& direction : patch.directions) {
    const UnivariateBasis basis = basisOf(direction);
    directions.push_back(valuesAt(basis, subdividedSpans(basis, subdivision)));
  }
  for (std::size_t d = 0; d < directions.size(); ++d) {
    const UnivariateBasis basis = basisOf(patch.directions[d]);
    for (const double breakpoint : basis.breakpoints()) {
      std::vector<PointRow> face = directions;
      face[d] = valuesAt(basis, {breakpoint});
      add(TensorPoints(patch, std::move(face)), false);
    }
  }
}

void BodySurface::add(TensorPoints points, bool clockwise) {
  std::vector<int> extent;
  for (const int n : points.box().extent)
    if (n > 1) extent.push_back(n);
  const int first = points_.size(), row = extent[0];
  for (int j = 0; j + 1 < extent[1]; ++j)
    for (int i = 0; i + 1 < row; ++i) {
      const int corner = first + j * row + i;
      const int second = corner + (clockwise ? row : 1), fourth = corner + (clockwise ? 1 : row);
      corners_.insert(corners_.end(), {corner, second, corner + row + 1, fourth});
    }
  points_.add(std::move(points));
}

vtkSmartPointer<vtkPolyData> BodySurface::displaced(const Eigen::MatrixXd& displacement) const {
  const Eigen::MatrixXd x = points_.positions(displacement);
  const auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(makePoints(x));
  surface->SetPolys(cells_);
  if (x.rows() == 3)
    surface->GetPointData()->SetNormals(
        makeArray("normals",
                  normalsOf(x, Eigen::Map<const Corners>(corners_.data(), 4, std::ssize(corners_) / 4)), {}));
  return surface;
}

}  // namespace burnish
