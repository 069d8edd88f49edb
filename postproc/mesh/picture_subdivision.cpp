#include "postproc/mesh/picture_subdivision.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "postproc/mesh/patch_borders.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/tensor_points.h"

namespace burnish {
namespace {

/// Values in rows and columns: components x (points of u x points of v), u first.
struct Grid {
  Eigen::MatrixXd values;
  Eigen::Index row = 0;  ///< points of u

  auto at(Eigen::Index i, Eigen::Index j) const { return values.col(i + row * j); }
  Eigen::Index columns() const { return values.cols() / row; }

  /// Points (i, j) to (i+n-1, j+m-1).
  Grid part(Eigen::Index i, Eigen::Index j, Eigen::Index n, Eigen::Index m) const {
    Grid part{Eigen::MatrixXd(values.rows(), n * m), n};
    for (Eigen::Index k = 0; k < m; ++k)
      part.values.middleCols(k * n, n) = values.middleCols(i + row * (j + k), n);
    return part;
  }

  /// Largest norm of the differences of order a in u and b in v.
  double difference(int a, int b) const {
    Grid of = *this;
    for (int k = 0; k < a; ++k) of = of.differences(true);
    for (int k = 0; k < b; ++k) of = of.differences(false);
    return of.values.size() == 0 ? 0.0 : of.values.colwise().norm().maxCoeff();
  }

 private:
  Grid differences(bool alongU) const {
    const Eigen::Index n = row - (alongU ? 1 : 0), m = columns() - (alongU ? 0 : 1);
    Grid result{Eigen::MatrixXd(values.rows(), std::max<Eigen::Index>(n * m, 0)), n};
    for (Eigen::Index j = 0; j < m; ++j)
      for (Eigen::Index i = 0; i < n; ++i)
        result.values.col(i + n * j) = (alongU ? at(i + 1, j) : at(i, j + 1)) - at(i, j);
    return result;
  }
};

/// Bounds of the second derivatives over a span.
struct Curvature {
  double uu = 0.0, uv = 0.0, vv = 0.0;
};

/// Of a rational span with these Bernstein coefficients and weights (one component). Taking the middle of the
/// coefficients from them keeps what comes from the weights small.
Curvature curvatureOf(const Grid& coefficients, const Grid& weights) {
  const Grid& w = weights;
  const Eigen::VectorXd middle =
      0.5 * (coefficients.values.rowwise().minCoeff() + coefficients.values.rowwise().maxCoeff());
  Grid a{coefficients.values.colwise() - middle, coefficients.row};
  const double r = a.values.colwise().norm().maxCoeff(), least = w.values.minCoeff();
  a.values.array().rowwise() *= w.values.row(0).array();
  const auto p = static_cast<double>(a.row - 1), q = static_cast<double>(a.columns() - 1);
  const double wu = p * w.difference(1, 0), wv = q * w.difference(0, 1);
  const double fu = (p * a.difference(1, 0) + wu * r) / least, fv = (q * a.difference(0, 1) + wv * r) / least;
  const double puu = p * (p - 1.0), pvv = q * (q - 1.0), puv = p * q;
  return {(puu * (a.difference(2, 0) + w.difference(2, 0) * r) + 2.0 * wu * fu) / least,
          (puv * (a.difference(1, 1) + w.difference(1, 1) * r) + wu * fv + wv * fu) / least,
          (pvv * (a.difference(0, 2) + w.difference(0, 2) * r) + 2.0 * wv * fv) / least};
}

/// An estimate from samples, n x n cells per span.
Curvature sampledCurvature(const Grid& samples, double n) {
  constexpr double kSafety = 2.0;
  const double scale = kSafety * n * n;
  return {scale * samples.difference(2, 0), scale * samples.difference(1, 1),
          scale * samples.difference(0, 2)};
}

std::array<int, 2> cellsFor(const Curvature& m, double tolerance) {
  const auto count = [&](double most) {
    const double n = std::ceil(std::sqrt(most / (4.0 * tolerance)));
    return static_cast<int>(std::clamp(n, 1.0, static_cast<double>(kMostCellsOfPicture)));
  };
  return {count(m.uu + m.uv), count(m.vv + m.uv)};
}

/// The counts of a patch that a side of it needs, which has two directions: a face, or all of a plane patch.
class SideCells {
 public:
  SideCells(const PatchRecord& patch, const PatchSide& side, const Eigen::MatrixXd& displacement,
            const PositionTolerance& positions, const ValueTolerance* values)
      : patch_(patch), side_(side), positions_(positions), values_(values) {
    for (std::size_t d = 0; d < side.ends.size(); ++d) {
      bases_.push_back(basisOf(patch.directions[d]));
      if (side.ends[d] == PatchSide::End::None) along_.push_back(d);
    }
    const TensorPoints points(patch,
                              rows([](const UnivariateBasis& basis) { return bernsteinPoints(basis); }));
    weights_ = {points.weights().transpose(), extentAlong(points)};
    x_ = {points.referencePoints(), weights_.row};
    if (displacement.size() > 0) x_.values += points.evaluate(displacement);
    if (values == nullptr) return;
    isMagnitude_ = values->coefficients.rows() > 1;
    f_ = isMagnitude_ ? magnitudes() : Grid{points.evaluate(values->coefficients), weights_.row};
  }

  /// Raises the counts of the patch, by direction and span, to what the side needs.
  void count(std::vector<std::vector<int>>& counts) const {
    for (int j = 0; j < bases_[along_[1]].numSpans(); ++j)
      for (int i = 0; i < bases_[along_[0]].numSpans(); ++i) {
        const std::array<int, 2> cells = cellsOf(i, j);
        int& ofU = counts[along_[0]][static_cast<std::size_t>(i)];
        int& ofV = counts[along_[1]][static_cast<std::size_t>(j)];
        ofU = std::max(ofU, cells[0]);
        ofV = std::max(ofV, cells[1]);
      }
  }

 private:
  static constexpr int kSamples = 8;  ///< cells per span and direction

  /// The rows of the side; pointsOf: along a direction that is not at an end.
  template <class PointsOf>
  std::vector<PointRow> rows(const PointsOf& pointsOf) const {
    std::vector<PointRow> rows;
    for (std::size_t d = 0; d < bases_.size(); ++d) {
      const std::vector<double>& breakpoints = bases_[d].breakpoints();
      const PatchSide::End end = side_.ends[d];
      rows.push_back(end == PatchSide::End::None
                         ? pointsOf(bases_[d])
                         : valuesAt(bases_[d], {end == PatchSide::End::Begin ? breakpoints.front()
                                                                             : breakpoints.back()}));
    }
    return rows;
  }

  Eigen::Index extentAlong(const TensorPoints& points) const { return points.box().extent[along_[0]]; }

  Grid magnitudes() const {
    const TensorPoints points(patch_, rows([](const UnivariateBasis& basis) {
                                return valuesAt(basis, subdividedSpans(basis, kSamples));
                              }));
    return {points.evaluate(values_->coefficients).colwise().norm(), extentAlong(points)};
  }

  std::array<int, 2> cellsOf(int i, int j) const {
    const int p = bases_[along_[0]].degree(), q = bases_[along_[1]].degree();
    const Grid w = weights_.part(p * i, q * j, p + 1, q + 1), x = x_.part(p * i, q * j, p + 1, q + 1);
    const Eigen::Matrix2Xd seen = positions_.axes.leftCols(x.values.rows()) * x.values;
    const Eigen::AlignedBox2d around(Eigen::Vector2d(seen.rowwise().minCoeff()),
                                     Eigen::Vector2d(seen.rowwise().maxCoeff()));
    if (!around.intersects(positions_.window)) return {1, 1};
    const std::array<int, 2> ofPositions = cellsFor(curvatureOf(x, w), positions_.length);
    if (values_ == nullptr) return ofPositions;
    const int n = isMagnitude_ ? kSamples : p, m = isMagnitude_ ? kSamples : q;
    const Grid f = f_.part(n * i, m * j, n + 1, m + 1);
    if (f.values.minCoeff() >= values_->range[1] || f.values.maxCoeff() <= values_->range[0])
      return ofPositions;
    const std::array<int, 2> ofValues =
        cellsFor(isMagnitude_ ? sampledCurvature(f, kSamples) : curvatureOf(f, w), values_->value);
    return {std::max(ofPositions[0], ofValues[0]), std::max(ofPositions[1], ofValues[1])};
  }

  const PatchRecord& patch_;
  const PatchSide& side_;
  const PositionTolerance& positions_;
  const ValueTolerance* values_;
  std::vector<UnivariateBasis> bases_;
  std::vector<std::size_t> along_;  ///< the two directions of the side
  bool isMagnitude_ = false;
  Grid weights_, x_, f_;
};

/// The counts along an edge of a patch.
std::vector<int>& countsAlong(Subdivision::Counts& counts, const PatchSide& edge) {
  const auto along = std::find(edge.ends.begin(), edge.ends.end(), PatchSide::End::None) - edge.ends.begin();
  return counts[edge.patch][static_cast<std::size_t>(along)];
}

/// Gives the spans along two edges in one place the larger count. Returns whether one has changed.
bool matched(const MeshRecord& mesh, Subdivision::Counts& counts, const PatchSide& one,
             const PatchSide& other) {
  std::vector<int>&a = countsAlong(counts, one), &b = countsAlong(counts, other);
  if (&a == &b || a.size() != b.size()) return false;
  const bool sameWay = nodesOn(mesh, one).front() == nodesOn(mesh, other).front();
  bool changed = false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    int &ofA = a[k], &ofB = b[sameWay ? k : b.size() - 1 - k];
    changed = changed || ofA != ofB;
    ofA = ofB = std::max(ofA, ofB);
  }
  return changed;
}

}  // namespace

Subdivision pictureSubdivision(const MeshRecord& mesh, const Eigen::MatrixXd& displacement,
                               const PositionTolerance& positions, const ValueTolerance* values) {
  const PatchBorders borders(mesh);
  Subdivision::Counts counts;
  for (const PatchRecord& patch : mesh.patches) {
    counts.emplace_back();
    for (const DirectionRecord& direction : patch.directions)
      counts.back().emplace_back(static_cast<std::size_t>(basisOf(direction).numSpans()), 1);
  }
  for (const PatchSide& side : borders.surface())
    SideCells(mesh.patches[side.patch], side, displacement, positions, values).count(counts[side.patch]);
  bool changed = true;
  while (changed) {  // a row may go through many patches
    changed = false;
    for (const std::vector<PatchSide>& edges : borders.sharedEdges())
      for (std::size_t k = 1; k < edges.size(); ++k) changed |= matched(mesh, counts, edges[0], edges[k]);
  }
  return Subdivision(std::move(counts));
}

}  // namespace burnish
