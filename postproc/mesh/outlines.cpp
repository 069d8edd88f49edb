#include "postproc/mesh/outlines.h"

#include <vtkPolyData.h>

#include <vector>

#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/poly_builder.h"

namespace burnish {
namespace {

/// The parameter lines of a patch along which all but `numInside` of the fixed parameters lie at an end of
/// their domain.
template <int Dim>
void addParameterLines(const Patch<Dim>& patch, int numInside, int subdivision, PolyBuilder& builder) {
  for (int along = 0; along < Dim; ++along) {
    const std::vector<double> parameters = subdividedSpans(patch.basis().direction(along), subdivision);
    Eigen::Matrix<int, Dim, 1> numFixed;
    for (int d = 0; d < Dim; ++d) numFixed(d) = d == along ? 1 : patch.basis().direction(d).numSpans() + 1;
    for (int line = 0; line < numFixed.prod(); ++line) {
      typename Patch<Dim>::Parameter xi;
      int inside = 0;
      for (int d = 0, rest = line; d < Dim; rest /= numFixed(d), ++d) {
        const int breakpoint = rest % numFixed(d);
        xi(d) = patch.basis().direction(d).breakpoints()[static_cast<std::size_t>(breakpoint)];
        if (d != along && breakpoint > 0 && breakpoint < numFixed(d) - 1) ++inside;
      }
      if (inside != numInside) continue;
      Eigen::MatrixXd positions(Dim, static_cast<Eigen::Index>(parameters.size()));
      for (Eigen::Index i = 0; i < positions.cols(); ++i) {
        xi(along) = parameters[static_cast<std::size_t>(i)];
        positions.col(i) = patch.position(xi);
      }
      builder.addLine(builder.addPoints(positions));
    }
  }
}

vtkSmartPointer<vtkPolyData> parameterLines(const ModelRecord& model, const Eigen::MatrixXd& displacement,
                                            int numInside, int subdivision) {
  PolyBuilder builder;
  for (const PatchRecord& record : model.patches) {
    if (model.dim == 2)
      addParameterLines(patchGeometry<2>(record, displacement), numInside, subdivision, builder);
    else
      addParameterLines(patchGeometry<3>(record, displacement), numInside, subdivision, builder);
  }
  return builder.finish();
}

}  // namespace

vtkSmartPointer<vtkPolyData> bodyOutline(const ModelRecord& model, const Eigen::MatrixXd& displacement,
                                         int subdivision) {
  return parameterLines(model, displacement, 0, subdivision);
}

vtkSmartPointer<vtkPolyData> knotLines(const ModelRecord& model, const Eigen::MatrixXd& displacement,
                                       int subdivision) {
  return parameterLines(model, displacement, 1, subdivision);
}

}  // namespace burnish
