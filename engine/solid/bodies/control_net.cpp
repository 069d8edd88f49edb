#include "engine/solid/bodies/control_net.h"

#include <fmt/format.h>

#include <utility>

#include "engine/core/error.h"
#include "engine/schema/problems.h"

namespace burnish {

std::vector<KnotVector> ControlNetBody::knotVectors() const {
  std::vector<KnotVector> directions;
  for (std::size_t d = 0; d < knots.size(); ++d) directions.emplace_back(degrees[d], knots[d]);
  return directions;
}

template <int Dim>
Patch<Dim> ControlNetBody::patch() const {
  std::vector<UnivariateBasis> directions;
  for (const KnotVector& direction : knotVectors()) directions.push_back(UnivariateBasis::bspline(direction));
  TensorBasis<Dim> basis(std::move(directions));
  Eigen::MatrixXd controlPoints(Dim, static_cast<Eigen::Index>(points.size()));
  for (std::size_t a = 0; a < points.size(); ++a)
    controlPoints.col(static_cast<Eigen::Index>(a)) =
        Eigen::Map<const Eigen::Vector<double, Dim>>(points[a].data());
  Eigen::VectorXd all = Eigen::VectorXd::Ones(controlPoints.cols());
  for (std::size_t a = 0; a < weights.size(); ++a) all(static_cast<Eigen::Index>(a)) = weights[a];
  return {std::move(basis), std::move(controlPoints), std::move(all)};
}

namespace {

/// Number of basis functions; 0 when a knot vector is unusable, which is reported.
std::size_t checkKnots(const ControlNetBody& net, const Problems& problems) {
  if (!problems.clean("knots")) return 0;
  if (net.knots.size() != net.degrees.size()) {
    problems.report("knots", fmt::format("found {} knot vectors for {} degrees; allowed: one per direction.",
                                         net.knots.size(), net.degrees.size()));
    return 0;
  }
  std::size_t functions = 1;
  for (std::size_t d = 0; d < net.knots.size(); ++d) {
    try {
      functions *= static_cast<std::size_t>(KnotVector(net.degrees[d], net.knots[d]).numFunctions());
    } catch (const Error& problem) {
      problems.report(fmt::format("knots[{}]", d), fmt::format("{}.", problem.what()));
      functions = 0;
    }
  }
  return functions;
}

}  // namespace

void check(const ControlNetBody& net, const Problems& problems) {
  if (net.degrees.empty() || !problems.clean("degrees")) return;
  const std::size_t functions = checkKnots(net, problems), dim = net.degrees.size();
  if (functions > 0 && problems.clean("points")) {
    for (std::size_t i = 0; i < net.points.size(); ++i)
      if (net.points[i].size() != dim)
        problems.report(fmt::format("points[{}]", i),
                        fmt::format("found {} coordinates; allowed: {}, one per direction of the body.",
                                    net.points[i].size(), dim));
    if (net.points.size() != functions)
      problems.report("points",
                      fmt::format("found {} points; allowed: {}, as many as the knots make basis functions.",
                                  net.points.size(), functions));
  }
  if (!net.weights.empty() && net.weights.size() != net.points.size() && problems.clean("points") &&
      problems.clean("weights"))
    problems.report("weights", fmt::format("found {} weights for {} points; allowed: one per control point.",
                                           net.weights.size(), net.points.size()));
}

template Patch<2> ControlNetBody::patch() const;
template Patch<3> ControlNetBody::patch() const;

}  // namespace burnish
