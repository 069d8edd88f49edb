#include "postproc/mesh/tessellation.h"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/error.h"
#include "engine/results/check_records.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

/// Numbering of a box of items, first direction fastest.
template <std::size_t Dim>
struct Box {
  std::array<int, Dim> extent;

  int size() const {
    int product = 1;
    for (const int n : extent) product *= n;
    return product;
  }
  int number(const std::array<int, Dim>& index) const {
    int result = 0;
    for (std::size_t d = Dim; d-- > 0;) result = result * extent[d] + index[d];
    return result;
  }
  std::array<int, Dim> index(int number) const {
    std::array<int, Dim> result;
    for (std::size_t d = 0; d < Dim; ++d) {
      result[d] = number % extent[d];
      number /= extent[d];
    }
    return result;
  }
};

/// Points and cells of the patches put together so far.
struct Parts {
  std::vector<Eigen::Triplet<double>> values;
  std::vector<double> coordinates;  ///< dim per point
  std::vector<int> corners;         ///< 2^dim per cell
  std::vector<int> patchOfCell;
  int numPoints = 0;
};

template <std::size_t Dim>
void addCells(const Box<Dim>& points, int patch, Parts& parts) {
  Box<Dim> cells = points;
  for (int& n : cells.extent) --n;
  for (int cell = 0; cell < cells.size(); ++cell) {
    for (int corner = 0; corner < (1 << Dim); ++corner) {
      // VTK goes round the quadrilateral, then round the one above it.
      const std::array<int, 3> offset{(corner ^ (corner >> 1)) & 1, (corner >> 1) & 1, corner >> 2};
      auto index = cells.index(cell);
      for (std::size_t d = 0; d < Dim; ++d) index[d] += offset[d];
      parts.corners.push_back(parts.numPoints + points.number(index));
    }
    parts.patchOfCell.push_back(patch);
  }
}

/// Adds a point with its basis values and its position Σ R_A X_A.
template <int Dim>
void addPoint(const PatchRecord& record, const Patch<Dim>& patch, int span,
              const typename Patch<Dim>::Parameter& xi, int point, Parts& parts) {
  const Eigen::VectorXd R = patch.shape(span, xi).R;
  const std::vector<int> functions = patch.basis().spanFunctions(span);
  for (std::size_t a = 0; a < functions.size(); ++a)
    parts.values.emplace_back(point, record.nodes[static_cast<std::size_t>(functions[a])],
                              R(static_cast<Eigen::Index>(a)));
  const typename Patch<Dim>::Point x = patch.points()(Eigen::all, functions) * R;
  parts.coordinates.insert(parts.coordinates.end(), x.begin(), x.end());
}

template <int Dim>
void addPatch(const PatchRecord& record, int number, int subdivision, Parts& parts) {
  constexpr auto kDim = static_cast<std::size_t>(Dim);
  const Patch<Dim> patch = patchGeometry<Dim>(record);
  std::array<std::vector<double>, kDim> parameters;
  Box<kDim> points;
  for (std::size_t d = 0; d < kDim; ++d) {
    parameters[d] = subdividedSpans(patch.basis().direction(static_cast<int>(d)), subdivision);
    points.extent[d] = static_cast<int>(parameters[d].size());
  }
  for (int point = 0; point < points.size(); ++point) {
    const auto index = points.index(point);
    std::array<int, kDim> spans;
    typename Patch<Dim>::Parameter xi;
    for (std::size_t d = 0; d < kDim; ++d) {
      // The last point of a direction belongs to its last span.
      spans[d] = std::min(index[d], points.extent[d] - 2) / subdivision;
      xi(static_cast<Eigen::Index>(d)) = parameters[d][static_cast<std::size_t>(index[d])];
    }
    addPoint(record, patch, patch.basis().spanNumber(spans), xi, parts.numPoints + point, parts);
  }
  addCells(points, number, parts);
  parts.numPoints += points.size();
}

void insertCells(const Tessellation& tessellation, vtkUnstructuredGrid& grid) {
  const Eigen::MatrixXi& cells = tessellation.cells();
  const int type = tessellation.dim() == 2 ? VTK_QUAD : VTK_HEXAHEDRON;
  std::array<vtkIdType, 8> corners{};
  grid.AllocateExact(cells.cols(), cells.size());
  for (const auto& cell : cells.colwise()) {
    std::copy(cell.begin(), cell.end(), corners.begin());
    grid.InsertNextCell(type, cells.rows(), corners.data());
  }
}

vtkSmartPointer<vtkIntArray> patchNumbers(const std::vector<int>& patchOfCell) {
  const auto array = vtkSmartPointer<vtkIntArray>::New();
  array->SetName("patch");
  array->SetNumberOfTuples(static_cast<vtkIdType>(patchOfCell.size()));
  std::copy(patchOfCell.begin(), patchOfCell.end(), array->GetPointer(0));
  return array;
}

/// The same vectors with a third component: only such fields can be used for warping.
Eigen::MatrixXd inSpace(const Eigen::MatrixXd& vectors) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3, vectors.cols());
  result.topRows(vectors.rows()) = vectors;
  return result;
}

}  // namespace

Tessellation::Tessellation(const ModelRecord& model, int subdivision) : dim_(model.dim) {
  checkModel(model, "model");
  Parts parts;
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    const auto add = dim_ == 2 ? addPatch<2> : addPatch<3>;
    add(model.patches[i], static_cast<int>(i), subdivision, parts);
  }
  values_.resize(parts.numPoints, model.numNodes);
  values_.setFromTriplets(parts.values.begin(), parts.values.end());
  referencePoints_ = Eigen::Map<const Eigen::MatrixXd>(parts.coordinates.data(), dim_, parts.numPoints);
  cells_ = Eigen::Map<const Eigen::MatrixXi>(parts.corners.data(), Eigen::Index{1} << dim_,
                                             static_cast<Eigen::Index>(parts.patchOfCell.size()));
  patchOfCell_ = std::move(parts.patchOfCell);
}

Eigen::MatrixXd Tessellation::evaluate(const Eigen::MatrixXd& coefficients) const {
  if (coefficients.cols() != values_.cols())
    throw Error(fmt::format("field: found values at {} nodes; the model has {}", coefficients.cols(),
                            values_.cols()));
  return (values_ * coefficients.transpose()).transpose();
}

vtkSmartPointer<vtkUnstructuredGrid> makeGrid(const Tessellation& tessellation, const FrameRecord& frame,
                                              bool deformed) {
  const Eigen::MatrixXd u = tessellation.evaluate(frame.displacement);
  if (u.rows() != tessellation.dim())
    throw Error(fmt::format("displacement: found {} components; the body has {} dimensions", u.rows(),
                            tessellation.dim()));
  const Eigen::MatrixXd& X = tessellation.referencePoints();
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(makePoints(deformed ? Eigen::MatrixXd(X + u) : X));
  insertCells(tessellation, *grid);
  grid->GetPointData()->AddArray(makeArray("displacement", inSpace(u), {"X", "Y", "Z"}));
  for (const auto& [name, field] : frame.fields)
    grid->GetPointData()->AddArray(makeArray(name, tessellation.evaluate(field.values), field.components));
  grid->GetCellData()->AddArray(patchNumbers(tessellation.patchOfCell()));
  return grid;
}

}  // namespace burnish
