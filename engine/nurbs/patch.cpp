#include "engine/nurbs/patch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/error.h"

namespace burnish::inline nurbs {
namespace {

constexpr std::array<const char*, 6> kFaceNames{"left", "right", "bottom", "top", "back", "front"};

template <std::size_t P>
int flatten(const std::array<int, P>& index, const std::array<int, P>& extent) {
  int number = 0;
  for (std::size_t d = P; d-- > 0;) number = number * extent[d] + index[d];
  return number;
}

template <std::size_t P>
std::array<int, P> unflatten(int number, const std::array<int, P>& extent) {
  std::array<int, P> index{};
  for (std::size_t d = 0; d < P; ++d) {
    index[d] = number % extent[d];
    number /= extent[d];
  }
  return index;
}

template <int P, class Extent>
std::array<int, P> extents(Extent&& extent) {
  std::array<int, P> result{};
  for (int d = 0; d < P; ++d) result[static_cast<std::size_t>(d)] = extent(d);
  return result;
}

template <int P>
std::array<int, P> functionExtents(const TensorBasis<P>& basis) {
  return extents<P>([&](int d) { return basis.direction(d).numFunctions(); });
}

template <int P>
std::array<int, P> spanExtents(const TensorBasis<P>& basis) {
  return extents<P>([&](int d) { return basis.direction(d).numSpans(); });
}

template <std::size_t P>
int product(const std::array<int, P>& extent) {
  int result = 1;
  for (const int n : extent) result *= n;
  return result;
}

}  // namespace

template <int P>
TensorBasis<P>::TensorBasis(std::vector<UnivariateBasis> directions) : directions_(std::move(directions)) {
  if (directions_.size() != static_cast<std::size_t>(P))
    throw Error(fmt::format("patch: {} univariate bases given, {} needed", directions_.size(), P));
}

template <int P>
int TensorBasis<P>::numFunctions() const {
  return product(functionExtents(*this));
}

template <int P>
int TensorBasis<P>::numSpans() const {
  return product(spanExtents(*this));
}

template <int P>
int TensorBasis<P>::functionsPerSpan() const {
  return product(extents<P>([&](int d) { return direction(d).degree() + 1; }));
}

template <int P>
typename TensorBasis<P>::Index TensorBasis<P>::spanIndex(int span) const {
  return unflatten(span, spanExtents(*this));
}

template <int P>
int TensorBasis<P>::spanNumber(const Index& index) const {
  return flatten(index, spanExtents(*this));
}

template <int P>
typename TensorBasis<P>::Index TensorBasis<P>::functionIndex(int function) const {
  return unflatten(function, functionExtents(*this));
}

template <int P>
int TensorBasis<P>::functionNumber(const Index& index) const {
  return flatten(index, functionExtents(*this));
}

template <int P>
Eigen::Vector<double, P> TensorBasis<P>::anchor(int function) const {
  const Index index = functionIndex(function);
  Eigen::Vector<double, P> xi;
  for (int d = 0; d < P; ++d) xi(d) = direction(d).anchor(index[static_cast<std::size_t>(d)]);
  return xi;
}

template <int P>
std::vector<int> TensorBasis<P>::spanFunctions(int span) const {
  const Index spans = spanIndex(span);
  const auto local = extents<P>([&](int d) { return direction(d).degree() + 1; });
  std::vector<int> functions(static_cast<std::size_t>(product(local)));
  for (std::size_t a = 0; a < functions.size(); ++a) {
    Index index = unflatten(static_cast<int>(a), local);
    for (std::size_t d = 0; d < P; ++d) index[d] += directions_[d].firstFunction(spans[d]);
    functions[a] = functionNumber(index);
  }
  return functions;
}

template <int P, int S>
Patch<P, S>::Patch(TensorBasis<P> basis, Eigen::MatrixXd points, Eigen::VectorXd weights)
    : basis_(std::move(basis)), points_(std::move(points)), weights_(std::move(weights)) {
  const int n = basis_.numFunctions();
  if (points_.rows() != S || points_.cols() != n)
    throw Error(fmt::format(
        "patch: {} control points of {} coordinates given; the basis has {} functions in {} dimensions",
        points_.cols(), points_.rows(), n, S));
  if (weights_.size() != n)
    throw Error(fmt::format("patch: {} weights given for {} control points", weights_.size(), n));
  for (int a = 0; a < n; ++a)
    if (!(weights_(a) > 0.0) || !std::isfinite(weights_(a)))
      throw Error(fmt::format("patch: weight {} is {}; weights must be positive", a + 1, weights_(a)));
  if (!points_.allFinite()) throw Error("patch: a control point is not finite");
}

template <int P, int S>
RationalShape<P> Patch<P, S>::shape(int span, const Parameter& xi) const {
  const auto spans = basis_.spanIndex(span);
  const auto functions = basis_.spanFunctions(span);
  const auto n = static_cast<Eigen::Index>(functions.size());

  // Columns: the polynomial tensor product, then its derivative in each direction.
  Eigen::MatrixXd N = Eigen::MatrixXd::Ones(n, P + 1);
  Eigen::Index block = 1;
  for (int d = 0; d < P; ++d) {
    const auto& univariate = basis_.direction(d);
    const Eigen::MatrixXd values = univariate.evaluate(spans[static_cast<std::size_t>(d)], xi(d), 1);
    const Eigen::Index m = values.rows();
    for (Eigen::Index a = 0; a < n; ++a) {
      const Eigen::Index i = (a / block) % m;
      for (int c = 0; c <= P; ++c) N(a, c) *= values(i, c == d + 1 ? 1 : 0);
    }
    block *= m;
  }

  for (Eigen::Index a = 0; a < n; ++a) N.row(a) *= weights_(functions[static_cast<std::size_t>(a)]);
  const Eigen::RowVectorXd W = N.colwise().sum();
  RationalShape<P> shape;
  shape.R = N.col(0) / W(0);
  shape.dR = (N.rightCols(P) - shape.R * W.tail(P)) / W(0);
  return shape;
}

template <int P, int S>
int Patch<P, S>::findSpan(const Parameter& xi) const {
  typename TensorBasis<P>::Index index{};
  for (int d = 0; d < P; ++d) index[static_cast<std::size_t>(d)] = basis_.direction(d).findSpan(xi(d));
  return basis_.spanNumber(index);
}

template <int P, int S>
typename Patch<P, S>::Point Patch<P, S>::position(const Parameter& xi) const {
  const int span = findSpan(xi);
  const auto functions = basis_.spanFunctions(span);
  return points_(Eigen::all, functions) * shape(span, xi).R;
}

template <int P, int S>
Eigen::Matrix<double, S, P> Patch<P, S>::jacobian(const Parameter& xi) const {
  const int span = findSpan(xi);
  const auto functions = basis_.spanFunctions(span);
  return points_(Eigen::all, functions) * shape(span, xi).dR;
}

template <int P>
FaceId faceFromName(const std::string& name) {
  const auto end = kFaceNames.begin() + 2 * P;
  const auto found = std::find(kFaceNames.begin(), end, name);
  if (found == end)
    throw Error(fmt::format("'{}' is not a face; in {} dimensions the faces are {}", name, P,
                            fmt::join(kFaceNames.begin(), end, ", ")));
  return static_cast<FaceId>(found - kFaceNames.begin());
}

const char* faceName(FaceId face) {
  return kFaceNames.at(static_cast<std::size_t>(face));
}

template <int P>
std::vector<int> faceFunctions(const TensorBasis<P>& basis, FaceId face) {
  const auto normal = static_cast<std::size_t>(face / 2);
  const int layer = face % 2 == 0 ? 0 : basis.direction(face / 2).numFunctions() - 1;
  std::vector<int> functions;
  for (int a = 0; a < basis.numFunctions(); ++a)
    if (basis.functionIndex(a)[normal] == layer) functions.push_back(a);
  return functions;
}

template <int P, int S>
Patch<P - 1, S> tracePatch(const Patch<P, S>& patch, FaceId face) {
  std::vector<UnivariateBasis> directions;
  for (int d = 0; d < P; ++d)
    if (d != face / 2) directions.push_back(patch.basis().direction(d));
  const auto functions = faceFunctions(patch.basis(), face);
  return {TensorBasis<P - 1>(std::move(directions)), patch.points()(Eigen::all, functions),
          patch.weights()(functions)};
}

template class TensorBasis<1>;
template class TensorBasis<2>;
template class TensorBasis<3>;
template class Patch<1, 2>;
template class Patch<1, 3>;
template class Patch<2, 2>;
template class Patch<2, 3>;
template class Patch<3, 3>;
template FaceId faceFromName<2>(const std::string&);
template FaceId faceFromName<3>(const std::string&);
template std::vector<int> faceFunctions(const TensorBasis<2>&, FaceId);
template std::vector<int> faceFunctions(const TensorBasis<3>&, FaceId);
template Patch<1, 2> tracePatch(const Patch<2, 2>&, FaceId);
template Patch<2, 3> tracePatch(const Patch<3, 3>&, FaceId);

}  // namespace burnish::inline nurbs
