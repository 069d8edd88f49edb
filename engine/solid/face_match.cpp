#include "engine/solid/face_match.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/nurbs/closest_point.h"

namespace burnish::inline solid {
namespace {

/// Points per direction of a face that is compared with another one, and starts of the search on that one.
constexpr int kSamples = 7, kStarts = 15;

/// Steps of that search: enough where faces meet, and elsewhere only the answer no is of interest.
constexpr int kSteps = 5;

/// Relative difference up to which knots and weights are the same.
constexpr double kSame = 1e-10;

/// Knots scaled to [0, 1], of the reversed direction if so wanted.
std::vector<double> scaledKnots(const UnivariateBasis& basis, bool reversed) {
  std::vector<double> knots = basis.knots();
  const double begin = knots.front(), length = knots.back() - begin;
  for (double& knot : knots) knot = (knot - begin) / length;
  if (!reversed) return knots;
  std::reverse(knots.begin(), knots.end());
  for (double& knot : knots) knot = 1.0 - knot;
  return knots;
}

bool sameKnots(const UnivariateBasis& first, const UnivariateBasis& second, bool reversed) {
  const auto a = scaledKnots(first, false), b = scaledKnots(second, reversed);
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return std::abs(x - y) <= kSame; });
}

std::optional<std::string> basisDifference(const UnivariateBasis& first, const UnivariateBasis& second,
                                           bool reversed) {
  if (first.degree() != second.degree())
    return fmt::format("their degrees are {} and {}", first.degree(), second.degree());
  if (first.numFunctions() != second.numFunctions())
    return fmt::format("they have {} and {} basis functions", first.numFunctions(), second.numFunctions());
  if (!sameKnots(first, second, reversed)) return "their knots differ";
  return std::nullopt;
}

/// A function's number when its first direction runs fastest, from a rule for each direction.
template <int P, class Rule>
int functionBy(const TensorBasis<P>& basis, Rule&& rule) {
  typename TensorBasis<P>::Index index{};
  for (int d = 0; d < P; ++d) index[static_cast<std::size_t>(d)] = rule(d);
  return basis.functionNumber(index);
}

/// The 2^P functions at the corners.
template <int P>
std::vector<int> cornerFunctions(const TensorBasis<P>& basis) {
  std::vector<int> corners;
  for (int corner = 0; corner < 1 << P; ++corner)
    corners.push_back(functionBy(
        basis, [&](int d) { return (corner >> d) % 2 == 0 ? 0 : basis.direction(d).numFunctions() - 1; }));
  return corners;
}

/// Function of the second basis at the corner that lies where corner number `corner` of the first one does.
template <int P>
int cornerCounterpart(const TensorBasis<P>& second, int corner, const FaceOrientation<P>& orientation) {
  typename TensorBasis<P>::Index index{};
  for (int d = 0; d < P; ++d) {
    const auto k = static_cast<std::size_t>(d);
    const bool atEnd = ((corner >> d) % 2 != 0) != orientation.reversed[k];
    const int along = orientation.along[k];
    index[static_cast<std::size_t>(along)] = atEnd ? second.direction(along).numFunctions() - 1 : 0;
  }
  return second.functionNumber(index);
}

/// Parameters of a grid of n points per direction between the ends.
template <int P>
std::vector<Eigen::Vector<double, P>> innerGrid(const TensorBasis<P>& basis, int n) {
  std::vector<double> shares;
  for (int i = 0; i < n; ++i) shares.push_back((i + 0.5) / n);
  return parameterGrid(basis, shares);
}

}  // namespace

template <>
std::vector<FaceOrientation<1>> faceOrientations() {
  return {{{0}, {false}}, {{0}, {true}}};
}

template <>
std::vector<FaceOrientation<2>> faceOrientations() {
  std::vector<FaceOrientation<2>> all;
  for (const auto& along : {std::array{0, 1}, std::array{1, 0}})
    for (const bool first : {false, true})
      for (const bool second : {false, true}) all.push_back({along, {first, second}});
  return all;
}

template <int P, int S>
bool cornersMeet(const Patch<P, S>& first, const Patch<P, S>& second, const FaceOrientation<P>& orientation,
                 double tolerance) {
  const auto corners = cornerFunctions(first.basis());
  for (int corner = 0; corner < 1 << P; ++corner) {
    const int other = cornerCounterpart(second.basis(), corner, orientation);
    if ((first.points().col(corners[static_cast<std::size_t>(corner)]) - second.points().col(other)).norm() >
        tolerance)
      return false;
  }
  return true;
}

template <int P, int S>
bool liesOn(const Patch<P, S>& first, const Patch<P, S>& second, double tolerance) {
  const auto samples = innerGrid(first.basis(), kSamples), starts = innerGrid(second.basis(), kStarts);
  return std::all_of(samples.begin(), samples.end(), [&](const auto& xi) {
    return closestPoint(second, first.position(xi), starts, kSteps).distance <= tolerance;
  });
}

template <int P, int S>
FaceSamples samplesOf(const Patch<P, S>& face) {
  const auto positions = [&](const auto& grid) {
    Eigen::MatrixXd points(S, static_cast<Eigen::Index>(grid.size()));
    for (std::size_t k = 0; k < grid.size(); ++k)
      points.col(static_cast<Eigen::Index>(k)) = face.position(grid[k]);
    return points;
  };
  FaceSamples samples{positions(innerGrid(face.basis(), kSamples)),
                      positions(innerGrid(face.basis(), kStarts)), 0.0};
  // The diagonal's half is at most 0.71 of the longest step between neighbours, which stand one or kStarts
  // apart.
  for (Eigen::Index k = 0; k < samples.all.cols(); ++k)
    for (const Eigen::Index step : {Eigen::Index{1}, Eigen::Index{kStarts}})
      if (k + step < samples.all.cols() && (step == kStarts || (k + 1) % kStarts != 0))
        if (P > 1 || step == 1)
          samples.reach = std::max(samples.reach, (samples.all.col(k + step) - samples.all.col(k)).norm());
  samples.reach *= P == 1 ? 0.55 : 0.75;
  return samples;
}

template <int P, int S>
bool touches(const FaceSamples& samples, const Patch<P, S>& face, const FaceSamples& ofFace,
             double tolerance) {
  const auto starts = innerGrid(face.basis(), kStarts);
  for (Eigen::Index k = 0; k < samples.inside.cols(); ++k) {
    Eigen::Index nearest = 0;
    const double away = (ofFace.all.colwise() - samples.inside.col(k)).colwise().norm().minCoeff(&nearest);
    if (away > ofFace.reach + tolerance) continue;
    const auto closest =
        closestPoint<P, S>(face, samples.inside.col(k), {starts[static_cast<std::size_t>(nearest)]}, kSteps);
    if (closest.distance <= tolerance) return true;
  }
  return false;
}

template <int P>
std::vector<int> counterparts(const TensorBasis<P>& first, const TensorBasis<P>& second,
                              const FaceOrientation<P>& orientation) {
  std::vector<int> result;
  for (int a = 0; a < first.numFunctions(); ++a) {
    const auto index = first.functionIndex(a);
    typename TensorBasis<P>::Index other{};
    for (std::size_t d = 0; d < P; ++d) {
      const int last = first.direction(static_cast<int>(d)).numFunctions() - 1;
      other[static_cast<std::size_t>(orientation.along[d])] =
          orientation.reversed[d] ? last - index[d] : index[d];
    }
    result.push_back(second.functionNumber(other));
  }
  return result;
}

template <int P, int S>
std::optional<std::string> faceDifference(const Patch<P, S>& first, const Patch<P, S>& second,
                                          const FaceOrientation<P>& orientation, double tolerance) {
  for (int d = 0; d < P; ++d) {
    const auto k = static_cast<std::size_t>(d);
    if (auto text = basisDifference(first.basis().direction(d),
                                    second.basis().direction(orientation.along[k]), orientation.reversed[k]))
      return text;
  }
  const auto other = counterparts(first.basis(), second.basis(), orientation);
  const Eigen::VectorXd weights = second.weights()(other);
  // The rational functions do not change when all weights grow by the same factor.
  const double factor = weights.maxCoeff() / first.weights().maxCoeff();
  if ((weights - factor * first.weights()).cwiseAbs().maxCoeff() > kSame * weights.maxCoeff())
    return "their weights differ";
  const double apart = (second.points()(Eigen::all, other) - first.points()).colwise().norm().maxCoeff();
  if (apart > tolerance) return fmt::format("their control points are up to {:.3g} apart", apart);
  return std::nullopt;
}

template bool cornersMeet(const Patch<1, 2>&, const Patch<1, 2>&, const FaceOrientation<1>&, double);
template bool cornersMeet(const Patch<2, 3>&, const Patch<2, 3>&, const FaceOrientation<2>&, double);
template FaceSamples samplesOf(const Patch<1, 2>&);
template FaceSamples samplesOf(const Patch<2, 3>&);
template bool touches(const FaceSamples&, const Patch<1, 2>&, const FaceSamples&, double);
template bool touches(const FaceSamples&, const Patch<2, 3>&, const FaceSamples&, double);
template bool liesOn(const Patch<1, 2>&, const Patch<1, 2>&, double);
template bool liesOn(const Patch<2, 3>&, const Patch<2, 3>&, double);
template std::optional<std::string> faceDifference(const Patch<1, 2>&, const Patch<1, 2>&,
                                                   const FaceOrientation<1>&, double);
template std::optional<std::string> faceDifference(const Patch<2, 3>&, const Patch<2, 3>&,
                                                   const FaceOrientation<2>&, double);
template std::vector<int> counterparts(const TensorBasis<1>&, const TensorBasis<1>&,
                                       const FaceOrientation<1>&);
template std::vector<int> counterparts(const TensorBasis<2>&, const TensorBasis<2>&,
                                       const FaceOrientation<2>&);

}  // namespace burnish::inline solid
