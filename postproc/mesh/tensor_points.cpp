#include "postproc/mesh/tensor_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/core/error.h"

namespace burnish {
namespace {

/// Replaces the functions of a direction by its points. q: a column per function, what varies faster than
/// this direction in it; the functions of slower directions follow. factors: of the direction, or its slopes.
/// Returns the same with points.
Eigen::MatrixXd replaced(const Eigen::MatrixXd& q, const PointRow& direction,
                         const Eigen::MatrixXd& factors) {
  const auto numPoints = static_cast<Eigen::Index>(direction.firstFunction.size());
  const Eigen::Index slower = q.cols() / direction.numFunctions;
  Eigen::MatrixXd result(q.rows(), numPoints * slower);
  for (Eigen::Index s = 0; s < slower; ++s)
    for (Eigen::Index i = 0; i < numPoints; ++i) {
      const int first = direction.firstFunction[static_cast<std::size_t>(i)];
      result.col(s * numPoints + i).noalias() =
          q.middleCols(s * direction.numFunctions + first, factors.rows()) * factors.col(i);
    }
  return result;
}

/// Leaves out the functions before and behind those that are needed. Returns how many were before.
int leaveOutUnneeded(PointRow& row) {
  const auto [low, high] = std::minmax_element(row.firstFunction.begin(), row.firstFunction.end());
  const int before = *low;
  row.numFunctions = *high - *low + static_cast<int>(row.factors.rows());
  for (int& first : row.firstFunction) first -= before;
  return before;
}

}  // namespace

PointRow neighbouring(const PointRow& row, int first, int count) {
  const auto begin = row.firstFunction.begin() + first;
  PointRow part{row.numFunctions, {begin, begin + count}, row.factors.middleCols(first, count)};
  if (row.slopes.size() > 0) part.slopes = row.slopes.middleCols(first, count);
  return part;
}

PointRow valuesAt(const UnivariateBasis& basis, const std::vector<double>& parameters) {
  PointRow row{basis.numFunctions(),
               {},
               Eigen::MatrixXd(basis.degree() + 1, static_cast<Eigen::Index>(parameters.size()))};
  for (Eigen::Index i = 0; i < row.factors.cols(); ++i) {
    const double xi = parameters[static_cast<std::size_t>(i)];
    const int span = basis.findSpan(xi);
    row.firstFunction.push_back(basis.firstFunction(span));
    row.factors.col(i) = basis.evaluate(span, xi, 0);
  }
  return row;
}

PointRow slopesAt(const UnivariateBasis& basis, const std::vector<double>& parameters, SpanSide side) {
  const auto count = static_cast<Eigen::Index>(parameters.size());
  PointRow row{basis.numFunctions(),
               {},
               Eigen::MatrixXd(basis.degree() + 1, count),
               Eigen::MatrixXd(basis.degree() + 1, count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const double xi = parameters[static_cast<std::size_t>(i)];
    int span = basis.findSpan(xi);
    if (side == SpanSide::Before && span > 0 && xi == basis.spanBegin(span)) --span;
    const Eigen::MatrixXd functions = basis.evaluate(span, xi, 1);
    row.firstFunction.push_back(basis.firstFunction(span));
    row.factors.col(i) = functions.col(0);
    row.slopes.col(i) = functions.col(1);
  }
  return row;
}

PointRow bernsteinPoints(const UnivariateBasis& basis) {
  const int p = basis.degree(), last = basis.numSpans() - 1;
  PointRow row{basis.numFunctions(), {}, Eigen::MatrixXd(p + 1, p * basis.numSpans() + 1)};
  for (int i = 0; i < row.factors.cols(); ++i) {
    const int span = std::min(i / p, last);  // the last point belongs to the last span
    row.firstFunction.push_back(basis.firstFunction(span));
    row.factors.col(i) = basis.extraction(span).col(i - p * span);
  }
  return row;
}

TensorPoints::TensorPoints(const PatchRecord& patch, std::vector<PointRow> directions)
    : directions_(std::move(directions)) {
  IndexBox all;
  IndexBox::Index before{0, 0, 0};
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    PointRow& row = directions_[d];
    all.extent[d] = row.numFunctions;
    before[d] = leaveOutUnneeded(row);
    functions_.extent[d] = row.numFunctions;
    points_.extent[d] = static_cast<int>(row.firstFunction.size());
  }
  std::vector<int> functions;
  for (int a = 0; a < functions_.size(); ++a) {
    IndexBox::Index index = functions_.index(a);
    for (std::size_t d = 0; d < 3; ++d) index[d] += before[d];
    functions.push_back(all.number(index));
    nodes_.push_back(patch.nodes[static_cast<std::size_t>(functions.back())]);
  }
  patchPoints_ = patch.points(Eigen::all, functions);
  functionWeights_ = patch.weights(functions);
  equalWeights_ = (functionWeights_.array() == functionWeights_(0)).all();
  weights_ = equalWeights_ ? Eigen::VectorXd::Constant(size(), functionWeights_(0))
                           : Eigen::VectorXd(polynomial(functionWeights_.transpose()).transpose());
}

Eigen::MatrixXd TensorPoints::evaluate(const Eigen::MatrixXd& coefficients) const {
  return rational(coefficients(Eigen::all, nodes_));
}

Eigen::MatrixXd TensorPoints::rational(const Eigen::MatrixXd& q) const {
  if (equalWeights_) return polynomial(q);
  Eigen::MatrixXd result = polynomial(q * functionWeights_.asDiagonal());
  result.array().rowwise() /= weights_.transpose().array();
  return result;
}

Eigen::MatrixXd TensorPoints::tangents(std::size_t direction, const Eigen::MatrixXd& displacement) const {
  Eigen::MatrixXd q = patchPoints_;
  if (displacement.size() > 0) q += displacement(Eigen::all, nodes_);
  if (equalWeights_) return functionWeights_(0) * polynomial(q, direction);
  const Eigen::RowVectorXd slopeOfWeight = polynomial(functionWeights_.transpose(), direction);
  return polynomial(q * functionWeights_.asDiagonal(), direction) - rational(q) * slopeOfWeight.asDiagonal();
}

Eigen::MatrixXd TensorPoints::polynomial(Eigen::MatrixXd q, std::optional<std::size_t> slope) const {
  const Eigen::Index components = q.rows();
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    const PointRow& direction = directions_[d];
    q = replaced(q, direction, slope == d ? direction.slopes : direction.factors);
    const auto numPoints = static_cast<Eigen::Index>(direction.firstFunction.size());
    q.resize(q.rows() * numPoints, q.cols() / numPoints);  // the same numbers in the same order
  }
  q.resize(components, size());
  return q;
}

void PointLattices::add(TensorPoints points) {
  size_ += points.size();
  lattices_.push_back(std::move(points));
}

Eigen::MatrixXd PointLattices::evaluate(const Eigen::MatrixXd& coefficients) const {
  if (coefficients.cols() != numNodes_)
    throw Error(
        fmt::format("field: found values at {} nodes; the mesh has {}", coefficients.cols(), numNodes_));
  Eigen::MatrixXd values(coefficients.rows(), size_);
  Eigen::Index first = 0;
  for (const TensorPoints& points : lattices_) {
    values.middleCols(first, points.size()) = points.evaluate(coefficients);
    first += points.size();
  }
  return values;
}

Eigen::MatrixXd PointLattices::referencePoints() const {
  Eigen::MatrixXd positions;
  Eigen::Index first = 0;
  for (const TensorPoints& points : lattices_) {
    const Eigen::MatrixXd added = points.referencePoints();
    if (first == 0) positions.resize(added.rows(), size_);
    positions.middleCols(first, added.cols()) = added;
    first += added.cols();
  }
  return positions;
}

Eigen::MatrixXd PointLattices::positions(const Eigen::MatrixXd& displacement) const {
  Eigen::MatrixXd positions = referencePoints();
  if (displacement.size() == 0) return positions;
  if (displacement.rows() != positions.rows())
    throw Error(fmt::format("displacement: found {} components; the body has {} dimensions",
                            displacement.rows(), positions.rows()));
  positions += evaluate(displacement);
  return positions;
}

Eigen::VectorXd PointLattices::weights() const {
  Eigen::VectorXd weights(size_);
  Eigen::Index first = 0;
  for (const TensorPoints& points : lattices_) {
    weights.segment(first, points.size()) = points.weights();
    first += points.size();
  }
  return weights;
}

}  // namespace burnish
