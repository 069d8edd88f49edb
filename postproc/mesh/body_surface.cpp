#include "postproc/mesh/body_surface.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/results/check_records.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

/// Normals of length 1; of length 0 where the tangents are parallel or there are none.
Eigen::Matrix3Xd normalsFrom(const Eigen::Matrix3Xd& tangents1, const Eigen::Matrix3Xd& tangents2) {
  constexpr double kParallel = 1e-8;
  Eigen::Matrix3Xd normals(3, tangents1.cols());
  const double longest = std::sqrt(
      std::max(tangents1.colwise().squaredNorm().maxCoeff(), tangents2.colwise().squaredNorm().maxCoeff()));
  for (Eigen::Index k = 0; k < normals.cols(); ++k) {
    const Eigen::Vector3d t1 = tangents1.col(k), t2 = tangents2.col(k), across = t1.cross(t2);
    const double length = across.norm();
    normals.col(k).setZero();
    if (length > kParallel * t1.norm() * t2.norm() && std::min(t1.norm(), t2.norm()) > kParallel * longest)
      normals.col(k) = across / length;
  }
  return normals;
}

/// Whether functions have kinks between spans.
bool hasCreases(const UnivariateBasis& basis) {
  const int last = basis.numSpans() - 1;
  for (int span = 0; span < last; ++span)
    if (basis.firstFunction(span + 1) == basis.firstFunction(span) + basis.degree()) return true;
  return false;
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
  std::vector<std::size_t> along;
  bool clockwise = false;
  for (std::size_t d = 0; d < side.ends.size(); ++d) {
    const UnivariateBasis basis = basisOf(patch.directions[d]);
    const bool atEnd = side.ends[d] == PatchSide::End::End;
    if (side.ends[d] == PatchSide::End::None) {
      along.push_back(d);
      parameters.push_back(subdivision.parameters(side.patch, d, basis));
      continue;
    }
    parameters.push_back({atEnd ? basis.breakpoints().back() : basis.breakpoints().front()});
    // Rows and columns of the second direction's faces are the first and the third direction, whose cross
    // product points backwards.
    clockwise = atEnd == (d == 1);
  }
  add(patch, parameters, clockwise);
  if (mesh.dim() < 3) return;
  std::array directions{along[0], along[1]};
  if (clockwise) std::swap(directions[0], directions[1]);
  tangents_.push_back(tangentsAt(patch, parameters, directions));
  if (kind_ == Cells::TrianglesAboutMiddles)
    tangents_.push_back(tangentsAt(patch, middlesOf(parameters), directions));
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

BodySurface::Tangents BodySurface::tangentsAt(const PatchRecord& patch,
                                              const std::vector<std::vector<double>>& parameters,
                                              const std::array<std::size_t, 2>& directions) {
  std::vector<std::vector<PointRow>> rows(1);  // of the directions, for every combination of sides
  std::vector<PointRow> inside;
  for (std::size_t d = 0; d < parameters.size(); ++d) {
    const UnivariateBasis basis = basisOf(patch.directions[d]);
    std::vector<SpanSide> sides{SpanSide::Behind};
    std::vector<double> within = parameters[d];
    // Even of one parameter: the middle of a single cell.
    if (d == directions[0] || d == directions[1]) {
      constexpr double kTrifle = 1e-6;
      const double middle = std::midpoint(within.front(), within.back());
      for (double& xi : within) xi = std::lerp(xi, middle, kTrifle);
      if (hasCreases(basis)) sides.push_back(SpanSide::Before);
    }
    inside.push_back(slopesAt(basis, within, SpanSide::Behind));
    std::vector<std::vector<PointRow>> combined;
    for (const std::vector<PointRow>& row : rows)
      for (const SpanSide side : sides) {
        combined.push_back(row);
        combined.back().push_back(slopesAt(basis, parameters[d], side));
      }
    rows = std::move(combined);
  }
  std::vector<TensorPoints> sides;
  for (std::vector<PointRow>& row : rows) sides.emplace_back(patch, std::move(row));
  return {directions, std::move(sides), TensorPoints(patch, std::move(inside))};
}

Eigen::Matrix3Xd BodySurface::normals(const Eigen::MatrixXd& displacement) const {
  Eigen::Matrix3Xd normals(3, points_.size());
  Eigen::Index first = 0;
  for (const auto& [directions, sides, inside] : tangents_) {
    const auto normalsOf = [&, &along = directions](const TensorPoints& points) {
      return normalsFrom(points.tangents(along[0], displacement), points.tangents(along[1], displacement));
    };
    Eigen::Matrix3Xd ofFace = normalsOf(sides.front());
    for (std::size_t k = 1; k < sides.size(); ++k) ofFace += normalsOf(sides[k]);
    if ((ofFace.colwise().squaredNorm().array() == 0.0).any()) {
      const Eigen::Matrix3Xd nearby = normalsOf(inside);
      for (Eigen::Index k = 0; k < ofFace.cols(); ++k)
        if (ofFace.col(k).isZero(0.0)) ofFace.col(k) = nearby.col(k);
    }
    for (const auto& normal : ofFace.colwise()) normals.col(first++) = normal.normalized();
  }
  return normals;
}

Eigen::Map<const Eigen::MatrixXi> BodySurface::cornersOfCells() const {
  const Eigen::Index perCell = kind_ == Cells::TrianglesAboutMiddles ? 3 : 4;
  return {corners_.data(), perCell, std::ssize(corners_) / perCell};
}

std::vector<BodySurface::Lattice> BodySurface::lattices() const {
  const std::vector<TensorPoints>& all = points_.lattices();
  std::vector<Lattice> lattices;
  for (std::size_t k = 0; k < all.size(); ++k) {
    lattices.push_back({all[k].box(), {{0, 0, 0}}});
    if (kind_ == Cells::TrianglesAboutMiddles) lattices.back().middles = all[++k].box();
  }
  return lattices;
}

vtkSmartPointer<vtkPolyData> BodySurface::displaced(const Eigen::MatrixXd& displacement) const {
  const Eigen::MatrixXd x = points_.positions(displacement);
  const auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(makePoints(x));
  surface->SetPolys(cells_);
  if (!tangents_.empty())
    surface->GetPointData()->SetNormals(makeArray("normals", normals(displacement), {}));
  return surface;
}

}  // namespace burnish
