#include "postproc/mesh/outlines.h"

#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "postproc/mesh/patch_borders.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/poly_builder.h"
#include "postproc/mesh/tensor_points.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

/// Where the points of a lattice lie along a direction of a patch.
enum class Along { Begin, End, Everywhere, BetweenSpans };

/// everywhere: where points lie that lie everywhere.
std::vector<double> parametersAt(const UnivariateBasis& basis, Along along, std::vector<double> everywhere) {
  const std::vector<double>& breakpoints = basis.breakpoints();
  if (along == Along::Begin) return {breakpoints.front()};
  if (along == Along::End) return {breakpoints.back()};
  if (along == Along::Everywhere) return everywhere;
  return {breakpoints.begin() + 1, breakpoints.end() - 1};
}

std::vector<Along> placesOn(const PatchSide& side) {
  std::vector<Along> places;
  for (const PatchSide::End end : side.ends)
    places.push_back(end == PatchSide::End::Begin ? Along::Begin
                     : end == PatchSide::End::End ? Along::End
                                                  : Along::Everywhere);
  return places;
}

/// Draws lines on the patches of a body.
class LineDrawer {
 public:
  LineDrawer(const MeshRecord& mesh, const Eigen::MatrixXd& displacement, const Subdivision& subdivision,
             const Eigen::MatrixXd* coefficients)
      : mesh_(mesh), displacement_(displacement), subdivision_(subdivision), coefficients_(coefficients) {
    if (coefficients) values_.resize(coefficients->rows(), 0);
  }

  void addEdge(const PatchSide& edge) { add(edge.patch, placesOn(edge)); }

  /// The lines between the spans of a face, or of a plane patch.
  void addKnotLines(const PatchSide& face) {
    const std::vector<Along> all = placesOn(face);
    for (std::size_t d = 0; d < all.size(); ++d) {
      std::vector<Along> places = all;
      if (std::exchange(places[d], Along::BetweenSpans) == Along::Everywhere) add(face.patch, places);
    }
  }

  vtkSmartPointer<vtkPolyData> finish() const {
    const auto lines = builder_.finish();
    if (coefficients_) lines->GetPointData()->AddArray(makeArray(kValuesAlong, values_, {}));
    return lines;
  }

 private:
  /// Lines along the one direction whose points lie everywhere.
  void add(std::size_t number, const std::vector<Along>& places) {
    const PatchRecord& patch = mesh_.patches[number];
    std::vector<PointRow> directions;
    for (std::size_t d = 0; d < places.size(); ++d) {
      const UnivariateBasis basis = basisOf(patch.directions[d]);
      const std::vector<double> parameters =
          parametersAt(basis, places[d], subdivision_.parameters(number, d, basis));
      if (parameters.empty()) return;
      directions.push_back(valuesAt(basis, parameters));
    }
    PointLattices points(mesh_.numNodes);
    points.add(TensorPoints(patch, std::move(directions)));
    const auto along = std::find(places.begin(), places.end(), Along::Everywhere) - places.begin();
    addLines(points.lattices().front().box(), static_cast<std::size_t>(along),
             builder_.addPoints(points.positions(displacement_)));
    if (!coefficients_) return;
    values_.conservativeResize(Eigen::NoChange, values_.cols() + points.size());
    values_.rightCols(points.size()) = points.evaluate(*coefficients_);
  }

  void addLines(const IndexBox& points, std::size_t along, const std::vector<vtkIdType>& ids) {
    IndexBox starts = points;
    starts.extent[along] = 1;
    for (int start = 0; start < starts.size(); ++start) {
      IndexBox::Index index = starts.index(start);
      std::vector<vtkIdType> line;
      for (index[along] = 0; index[along] < points.extent[along]; ++index[along])
        line.push_back(ids[static_cast<std::size_t>(points.number(index))]);
      builder_.addLine(line);
    }
  }

  const MeshRecord& mesh_;
  const Eigen::MatrixXd& displacement_;
  const Subdivision& subdivision_;
  const Eigen::MatrixXd* coefficients_;
  Eigen::MatrixXd values_;  ///< components x points, with coefficients
  PolyBuilder builder_;
};

}  // namespace

vtkSmartPointer<vtkPolyData> bodyOutline(const MeshRecord& mesh, const Eigen::MatrixXd& displacement,
                                         const Subdivision& subdivision,
                                         const Eigen::MatrixXd* coefficients) {
  LineDrawer drawer(mesh, displacement, subdivision, coefficients);
  const PatchBorders borders(mesh);
  for (const PatchSide& edge : borders.outline()) drawer.addEdge(edge);
  return drawer.finish();
}

vtkSmartPointer<vtkPolyData> knotLines(const MeshRecord& mesh, const Eigen::MatrixXd& displacement,
                                       const Subdivision& subdivision, const Eigen::MatrixXd* coefficients) {
  LineDrawer drawer(mesh, displacement, subdivision, coefficients);
  const PatchBorders borders(mesh);
  for (const PatchSide& face : borders.surface()) drawer.addKnotLines(face);
  for (const PatchSide& seam : borders.seams()) drawer.addEdge(seam);
  return drawer.finish();
}

}  // namespace burnish
