#include "postproc/mesh/patch_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/error.h"

namespace burnish {
UnivariateBasis basisOf(const DirectionRecord& direction) {
  return direction.family == BasisFamily::BSpline
             ? UnivariateBasis::bspline(KnotVector(direction.degree, direction.knots))
             : UnivariateBasis::lagrange(direction.degree, direction.knots);
}

template <int Dim>
Patch<Dim> patchGeometry(const PatchRecord& record) {
  return patchGeometry<Dim>(record, Eigen::MatrixXd());
}

template <int Dim>
Patch<Dim> patchGeometry(const PatchRecord& record, const Eigen::MatrixXd& displacement) {
  std::vector<UnivariateBasis> directions;
  for (const DirectionRecord& direction : record.directions) directions.push_back(basisOf(direction));
  Eigen::MatrixXd points = record.points;
  if (displacement.size() > 0) {
    const int last = *std::max_element(record.nodes.begin(), record.nodes.end());
    if (displacement.rows() != Dim || displacement.cols() <= last)
      throw Error(fmt::format("displacement: found {} components at {} nodes; expected {} at {} or more",
                              displacement.rows(), displacement.cols(), Dim, last + 1));
    points += displacement(Eigen::all, record.nodes);
  }
  return Patch<Dim>(TensorBasis<Dim>(std::move(directions)), std::move(points), record.weights);
}

std::vector<double> subdividedSpans(const UnivariateBasis& basis, int subdivision) {
  if (subdivision < 1)
    throw Error(fmt::format("subdivision: found {}; expected at least 1 cell per knot span", subdivision));
  std::vector<double> parameters;
  for (int span = 0; span < basis.numSpans(); ++span)
    for (int k = 0; k < subdivision; ++k)
      parameters.push_back(std::lerp(basis.spanBegin(span), basis.spanEnd(span),
                                     static_cast<double>(k) / static_cast<double>(subdivision)));
  parameters.push_back(basis.breakpoints().back());
  return parameters;
}

template Patch<2> patchGeometry<2>(const PatchRecord&);
template Patch<3> patchGeometry<3>(const PatchRecord&);
template Patch<2> patchGeometry<2>(const PatchRecord&, const Eigen::MatrixXd&);
template Patch<3> patchGeometry<3>(const PatchRecord&, const Eigen::MatrixXd&);

}  // namespace burnish
