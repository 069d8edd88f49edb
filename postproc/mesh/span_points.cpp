#include "postproc/mesh/span_points.h"

#include <fmt/format.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <utility>

#include "engine/core/error.h"
#include "engine/results/check_records.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {

IndexBox PatchLattice::points() const {
  IndexBox box;
  for (std::size_t d = 0; d < 3; ++d) box.extent[d] = spans.extent[d] * steps[d] + 1;
  return box;
}

int PatchLattice::point(const IndexBox::Index& span, const IndexBox::Index& local) const {
  IndexBox::Index index;
  for (std::size_t d = 0; d < 3; ++d) index[d] = span[d] * steps[d] + local[d];
  return firstPoint + points().number(index);
}

SpanPoints::SpanPoints(const MeshRecord& mesh, PointMeaning meaning,
                       const std::function<int(const DirectionRecord&)>& steps, const MeshPiece* piece)
    : points_(mesh.numNodes) {
  checkMesh(mesh, mesh.dim(), "mesh");
  for (std::size_t number = 0; number < mesh.patches.size(); ++number) {
    const PatchRecord& patch = mesh.patches[number];
    const bool isLeftOut = piece != nullptr && piece->patch != number;
    PatchLattice lattice;
    lattice.firstPoint = points_.size();
    std::vector<PointRow> directions;
    for (std::size_t d = 0; d < patch.directions.size(); ++d) {
      const UnivariateBasis basis = basisOf(patch.directions[d]);
      lattice.steps[d] = steps(patch.directions[d]);
      lattice.spans.extent[d] = isLeftOut ? 0 : basis.numSpans();
      if (isLeftOut) continue;
      PointRow row = meaning == PointMeaning::Value
                         ? valuesAt(basis, subdividedSpans(basis, lattice.steps[d]))
                         : bernsteinPoints(basis);
      if (piece != nullptr && piece->direction == d) {
        lattice.spans.extent[d] = piece->numSpans;
        row = neighbouring(row, piece->firstSpan * lattice.steps[d], piece->numSpans * lattice.steps[d] + 1);
      }
      directions.push_back(std::move(row));
    }
    patches_.push_back(lattice);
    if (!isLeftOut) points_.add(TensorPoints(patch, std::move(directions)));
  }
  referencePoints_ = points_.referencePoints();
}

void setPoints(vtkUnstructuredGrid& grid, const SpanPoints& points, const FrameRecord& frame, bool deformed,
               const std::string& lengthUnit) {
  const Eigen::MatrixXd u = points.evaluate(frame.displacement);
  if (u.rows() != points.dim())
    throw Error(
        fmt::format("displacement: found {} components; the body has {} dimensions", u.rows(), points.dim()));
  const Eigen::MatrixXd& X = points.referencePoints();
  grid.SetPoints(makePoints(deformed ? Eigen::MatrixXd(X + u) : X));
  grid.GetPointData()->AddArray(makeArray(labelled("displacement", lengthUnit), inSpace(u), kAxes));
  for (const auto& [name, field] : frame.fields)
    grid.GetPointData()->AddArray(
        makeArray(labelled(name, field.unit), points.evaluate(field.values), field.components));
}

}  // namespace burnish
