#include "engine/tools/nurbs_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/core/error.h"
#include "engine/schema/coordinates.h"
#include "engine/tools/nurbs_distance.h"
#include "engine/tools/shape_problems.h"

namespace burnish::inline tools {
namespace {

template <int P>
NurbsShape<P> shapeOf(const NurbsTool& nurbs) {
  std::vector<UnivariateBasis> directions;
  for (std::size_t d = 0; d < nurbs.knots.size(); ++d)
    directions.push_back(UnivariateBasis::bspline(KnotVector(nurbs.degrees[d], nurbs.knots[d])));
  Eigen::MatrixXd points(3, static_cast<Eigen::Index>(nurbs.points.size()));
  for (std::size_t a = 0; a < nurbs.points.size(); ++a)
    points.col(static_cast<Eigen::Index>(a)) = Point(nurbs.points[a]);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(points.cols());
  std::copy(nurbs.weights.begin(), nurbs.weights.end(), weights.begin());
  return makeNurbsShape(Patch<P, 3>(TensorBasis<P>(std::move(directions)), std::move(points), weights),
                        nurbs.flip);
}

}  // namespace

template <int P>
GapQuery NurbsShape<P>::query(const Eigen::Vector3d& x) const {
  return distance->query(x);
}

template <int P>
double NurbsShape<P>::halfThickness() const {
  return distance->halfThickness();
}

template <int P>
Eigen::Vector3d NurbsShape<P>::middle() const {
  return middleOfBox(distance->outline());
}

template <int P>
SurfaceMesh NurbsShape<P>::outline(int /*dim*/, double /*reach*/) const {
  return distance->outline();
}

template <int P>
NurbsShape<P> makeNurbsShape(Patch<P, 3> patch, bool flip) {
  return {std::make_shared<const NurbsDistance<P>>(std::move(patch), flip)};
}

RigidShape NurbsTool::made() const {
  return degrees.size() == 1 ? RigidShape(shapeOf<1>(*this)) : RigidShape(shapeOf<2>(*this));
}

void check(const NurbsTool& nurbs, const ShapeProblems& problems) {
  const int dim = problems.dim();
  if (!problems.clean("degrees") || !problems.clean("knots") || !problems.clean("points") || dim == 0) return;
  if (std::ssize(nurbs.degrees) != dim - 1)
    return problems.report("degrees", fmt::format("found {} degrees; allowed: {}.", nurbs.degrees.size(),
                                                  dim == 2 ? "1, that of a curve" : "2, those of a surface"));
  if (nurbs.knots.size() != nurbs.degrees.size())
    return problems.report("knots",
                           fmt::format("found {} knot vectors for {} degrees; allowed: one per direction.",
                                       nurbs.knots.size(), nurbs.degrees.size()));
  std::size_t functions = 1;
  for (std::size_t d = 0; d < nurbs.knots.size(); ++d) {
    try {
      functions *= static_cast<std::size_t>(KnotVector(nurbs.degrees[d], nurbs.knots[d]).numFunctions());
    } catch (const Error& problem) {
      return problems.report(fmt::format("knots[{}]", d), fmt::format("{}.", problem.what()));
    }
  }
  problems.requireDimension("points", nurbs.points, dim);
  if (nurbs.points.size() != functions)
    problems.report("points",
                    fmt::format("found {} points; allowed: {}, as many as the knots make basis functions.",
                                nurbs.points.size(), functions));
  if (!nurbs.weights.empty() && nurbs.weights.size() != nurbs.points.size() && problems.clean("weights"))
    problems.report("weights", fmt::format("found {} weights for {} points; allowed: one per control point.",
                                           nurbs.weights.size(), nurbs.points.size()));
}

template struct NurbsShape<1>;
template struct NurbsShape<2>;
template NurbsShape<1> makeNurbsShape(Patch<1, 3>, bool);
template NurbsShape<2> makeNurbsShape(Patch<2, 3>, bool);

}  // namespace burnish::inline tools
