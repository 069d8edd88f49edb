#include "engine/solid/bodies/net.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/core/error.h"
#include "engine/schema/problems.h"

namespace burnish::inline solid {
namespace {

/// Number of basis functions; 0 when a knot vector is unusable, which is reported.
std::size_t checkKnots(const Net& net, const Problems& problems, const std::string& key) {
  if (!problems.clean(key + "knots")) return 0;
  if (!net.knots.empty() && net.knots.size() != net.degrees.size()) {
    problems.report(key + "knots",
                    fmt::format("found {} knot vectors for {} degrees; allowed: one per direction.",
                                net.knots.size(), net.degrees.size()));
    return 0;
  }
  std::size_t functions = 1;
  for (std::size_t d = 0; d < net.knots.size(); ++d) {
    try {
      functions *= static_cast<std::size_t>(KnotVector(net.degrees[d], net.knots[d]).numFunctions());
    } catch (const Error& problem) {
      problems.report(fmt::format("{}knots[{}]", key, d), fmt::format("{}.", problem.what()));
      functions = 0;
    }
  }
  return functions;
}

/// Without knots: a curve needs enough points, more directions those of one span.
void checkWithoutKnots(const Net& net, const Problems& problems, const std::string& key) {
  if (net.degrees.size() == 1 && net.points.size() <= static_cast<std::size_t>(net.degrees[0]))
    return problems.report(
        key + "points", fmt::format("found {} points; allowed for degree {}: at least {}.", net.points.size(),
                                    net.degrees[0], net.degrees[0] + 1));
  std::size_t functions = 1;
  for (const int degree : net.degrees) functions *= static_cast<std::size_t>(degree) + 1;
  if (net.degrees.size() > 1 && net.points.size() != functions)
    problems.report(
        key + "points",
        fmt::format("found {} points; allowed without knots: {}, those of one span in each direction.",
                    net.points.size(), functions));
}

}  // namespace

std::vector<KnotVector> Net::knotVectors() const {
  std::vector<KnotVector> directions;
  for (std::size_t d = 0; d < degrees.size(); ++d)
    if (!knots.empty())
      directions.emplace_back(degrees[d], knots[d]);
    else
      directions.push_back(KnotVector::uniform(
          degrees[d], degrees.size() == 1 ? static_cast<int>(points.size()) - degrees[d] : 1));
  return directions;
}

template <int P, int S>
Patch<P, S> Net::patch() const {
  std::vector<UnivariateBasis> directions;
  for (const KnotVector& direction : knotVectors()) directions.push_back(UnivariateBasis::bspline(direction));
  TensorBasis<P> basis(std::move(directions));
  Eigen::MatrixXd controlPoints = Eigen::MatrixXd::Zero(S, static_cast<Eigen::Index>(points.size()));
  for (std::size_t a = 0; a < points.size(); ++a)
    std::copy_n(points[a].begin(), std::min<std::size_t>(points[a].size(), S),
                controlPoints.col(static_cast<Eigen::Index>(a)).begin());
  Eigen::VectorXd all = Eigen::VectorXd::Ones(controlPoints.cols());
  for (std::size_t a = 0; a < weights.size(); ++a) all(static_cast<Eigen::Index>(a)) = weights[a];
  return {std::move(basis), std::move(controlPoints), std::move(all)};
}

void checkNet(const Net& net, const Problems& problems, const std::string& key,
              std::array<std::size_t, 2> coordinates, const char* of) {
  if (net.degrees.empty() || !problems.clean(key + "degrees")) return;
  const std::size_t functions = checkKnots(net, problems, key);
  if (functions > 0 && problems.clean(key + "points")) {
    for (std::size_t i = 0; i < net.points.size(); ++i)
      if (std::ranges::find(coordinates, net.points[i].size()) == coordinates.end())
        problems.report(fmt::format("{}points[{}]", key, i),
                        coordinates[0] == coordinates[1]
                            ? fmt::format("found {} coordinates; allowed: {}, one per direction of {}.",
                                          net.points[i].size(), coordinates[0], of)
                            : fmt::format("found {} coordinates; allowed: {} or {}.", net.points[i].size(),
                                          coordinates[0], coordinates[1]));
    if (net.knots.empty())
      checkWithoutKnots(net, problems, key);
    else if (net.points.size() != functions)
      problems.report(key + "points",
                      fmt::format("found {} points; allowed: {}, as many as the knots make basis functions.",
                                  net.points.size(), functions));
  }
  if (!net.weights.empty() && net.weights.size() != net.points.size() && problems.clean(key + "points") &&
      problems.clean(key + "weights"))
    problems.report(key + "weights",
                    fmt::format("found {} weights for {} points; allowed: one per control point.",
                                net.weights.size(), net.points.size()));
}

template Patch<2, 2> Net::patch() const;
template Patch<3, 3> Net::patch() const;
template Patch<1, 3> Net::patch() const;
template Patch<2, 3> Net::patch() const;

}  // namespace burnish::inline solid
