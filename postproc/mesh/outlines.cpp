#include "postproc/mesh/outlines.h"

#include <vtkPolyData.h>

#include <utility>
#include <vector>

#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/poly_builder.h"
#include "postproc/mesh/tensor_points.h"

namespace burnish {
namespace {

/// Lines along a direction of the points.
void addLines(const IndexBox& points, std::size_t along, const std::vector<vtkIdType>& ids,
              PolyBuilder& builder) {
  IndexBox starts = points;
  starts.extent[along] = 1;
  for (int start = 0; start < starts.size(); ++start) {
    IndexBox::Index index = starts.index(start);
    std::vector<vtkIdType> line;
    for (index[along] = 0; index[along] < points.extent[along]; ++index[along])
      line.push_back(ids[static_cast<std::size_t>(points.number(index))]);
    builder.addLine(line);
  }
}

/// Parameter lines of a patch along one direction. The other parameters lie at the ends of their domains, but
/// for that of the direction `inside` (none: the direction itself), which lies between knot spans.
void addParameterLines(const ModelRecord& model, const PatchRecord& patch,
                       const Eigen::MatrixXd& displacement, std::size_t along, std::size_t inside,
                       int subdivision, PolyBuilder& builder) {
  std::vector<PointRow> directions;
  for (std::size_t d = 0; d < patch.directions.size(); ++d) {
    const UnivariateBasis basis = basisOf(patch.directions[d]);
    const std::vector<double>& breakpoints = basis.breakpoints();
    std::vector<double> parameters{breakpoints.front(), breakpoints.back()};
    if (d == along)
      parameters = subdividedSpans(basis, subdivision);
    else if (d == inside)
      parameters.assign(breakpoints.begin() + 1, breakpoints.end() - 1);
    if (parameters.empty()) return;
    directions.push_back(valuesAt(basis, parameters));
  }
  PointLattices points(model.numNodes);
  points.add(TensorPoints(patch, std::move(directions)));
  addLines(points.lattices().front().box(), along, builder.addPoints(points.positions(displacement)),
           builder);
}

}  // namespace

vtkSmartPointer<vtkPolyData> bodyOutline(const ModelRecord& model, const Eigen::MatrixXd& displacement,
                                         int subdivision) {
  PolyBuilder builder;
  for (const PatchRecord& patch : model.patches)
    for (std::size_t along = 0; along < patch.directions.size(); ++along)
      addParameterLines(model, patch, displacement, along, along, subdivision, builder);
  return builder.finish();
}

vtkSmartPointer<vtkPolyData> knotLines(const ModelRecord& model, const Eigen::MatrixXd& displacement,
                                       int subdivision) {
  PolyBuilder builder;
  for (const PatchRecord& patch : model.patches)
    for (std::size_t along = 0; along < patch.directions.size(); ++along)
      for (std::size_t inside = 0; inside < patch.directions.size(); ++inside)
        if (inside != along)
          addParameterLines(model, patch, displacement, along, inside, subdivision, builder);
  return builder.finish();
}

}  // namespace burnish
