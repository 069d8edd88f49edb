#include "postproc/mesh/picture_subdivision.h"

#include <algorithm>
#include <bit>
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

  /// Bernstein coefficients of a half of the span, of all components.
  Grid half(bool alongU, bool second) const {
    Grid result = *this;
    const Eigen::Index n = alongU ? row : columns();
    for (Eigen::Index step = 1; step < n; ++step)  // after each the points before it, or behind it, are done
      for (Eigen::Index k = 0; k < n - step; ++k) {
        const Eigen::Index at = second ? k : n - 1 - k;
        result.average(alongU, at, second ? at + 1 : at - 1);
      }
    return result;
  }

  /// Largest norm of the differences of order a in u and b in v.
  double difference(int a, int b) const {
    Grid of = *this;
    for (int k = 0; k < a; ++k) of = of.differences(true);
    for (int k = 0; k < b; ++k) of = of.differences(false);
    return of.values.size() == 0 ? 0.0 : of.values.colwise().norm().maxCoeff();
  }

 private:
  /// Gives the points of one number along a direction the mean of theirs and of those of another.
  void average(bool alongU, Eigen::Index at, Eigen::Index other) {
    for (Eigen::Index k = 0; k < (alongU ? columns() : row); ++k) {
      const auto place = [&](Eigen::Index i) { return alongU ? i + row * k : k + row * i; };
      values.col(place(at)) = 0.5 * (values.col(place(at)) + values.col(place(other)));
    }
  }

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

Eigen::Array2d cellsFor(const Curvature& m, double tolerance) {
  return (Eigen::Array2d(m.uu + m.uv, m.vv + m.uv) / (4.0 * tolerance)).sqrt().ceil();
}

/// A span or a part of it, in Bernstein form: rational positions and values, with their weights.
struct SpanPart {
  Grid w, x, f;  ///< f: empty where there are no values

  SpanPart half(bool alongU, bool second) const {
    SpanPart result{w.half(alongU, second), {}, {}};
    const auto halfOf = [&](const Grid& of) {
      Grid weighted = of;
      weighted.values.array().rowwise() *= w.values.row(0).array();
      Grid part = weighted.half(alongU, second);
      part.values.array().rowwise() /= result.w.values.row(0).array();
      return part;
    };
    result.x = halfOf(x);
    if (f.values.size() > 0) result.f = halfOf(f);
    return result;
  }
};

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

  /// Refines the cells of the patch, by direction and span, to what the side needs.
  void refine(std::vector<std::vector<SpanCells>>& cells) const {
    for (int j = 0; j < bases_[along_[1]].numSpans(); ++j)
      for (int i = 0; i < bases_[along_[0]].numSpans(); ++i) {
        const std::array<SpanCells, 2> needed = cellsOf(i, j);
        cells[along_[0]][static_cast<std::size_t>(i)].refine(needed[0]);
        cells[along_[1]][static_cast<std::size_t>(j)].refine(needed[1]);
      }
  }

 private:
  static constexpr int kSamples = 8;  ///< cells per span and direction
  static constexpr int kDepthOfMost = std::bit_width(static_cast<unsigned>(kMostCellsOfPicture)) - 1;
  static constexpr int kDeepest = 30;  ///< beyond that, where numbers end
  /// Of a span, with repetitions; what is seen of one has a quarter of them.
  static constexpr std::size_t kEnoughCuts = 50'000;

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

  Eigen::AlignedBox2d boxOf(const SpanPart& part) const {
    const Eigen::Matrix2Xd seen = positions_.axes.leftCols(part.x.values.rows()) * part.x.values;
    return {Eigen::Vector2d(seen.rowwise().minCoeff()), Eigen::Vector2d(seen.rowwise().maxCoeff())};
  }

  bool isToldApart(const Grid& f) const {
    return f.values.size() > 0 && f.values.minCoeff() < values_->range[1] &&
           f.values.maxCoeff() > values_->range[0];
  }

  /// Of a part that is seen.
  Eigen::Array2d cellsNeeded(const SpanPart& part) const {
    Eigen::Array2d cells = cellsFor(curvatureOf(part.x, part.w), positions_.length);
    if (isToldApart(part.f)) cells = cells.max(cellsFor(curvatureOf(part.f, part.w), values_->value));
    return cells.max(1.0);
  }

  std::array<SpanCells, 2> cellsOf(int i, int j) const {
    const int p = bases_[along_[0]].degree(), q = bases_[along_[1]].degree();
    const SpanPart whole{weights_.part(p * i, q * j, p + 1, q + 1), x_.part(p * i, q * j, p + 1, q + 1),
                         values_ == nullptr || isMagnitude_ ? Grid{} : f_.part(p * i, q * j, p + 1, q + 1)};
    const Eigen::AlignedBox2d around = boxOf(whole);
    if (!around.intersects(positions_.window)) return {};
    Eigen::Array2d needed = cellsNeeded(whole);
    if (isMagnitude_) {
      const Grid f = f_.part(kSamples * i, kSamples * j, kSamples + 1, kSamples + 1);
      if (isToldApart(f)) needed = needed.max(cellsFor(sampledCurvature(f, kSamples), values_->value));
    }
    std::array<SpanCells, 2> cells;
    for (const Eigen::Index d : {0, 1})
      cells[static_cast<std::size_t>(d)].count =
          static_cast<int>(std::min(needed(d), static_cast<double>(kMostCellsOfPicture)));
    const double parts = around.sizes().maxCoeff() / positions_.window.sizes().maxCoeff();
    if (needed.maxCoeff() > kMostCellsOfPicture && parts > 1.0) {
      const int deepest = kDepthOfMost + std::min(kDeepest, static_cast<int>(std::ceil(std::log2(parts))));
      addCuts(whole, {Half{}, Half{}}, deepest, cells);
      for (SpanCells& along : cells) {
        std::ranges::sort(along.cuts);
        const auto repeated = std::ranges::unique(along.cuts);
        along.cuts.erase(repeated.begin(), repeated.end());
      }
    }
    return cells;
  }

  /// One of 2^depth equal parts of a span in one direction.
  struct Half {
    int depth = 0;
    double begin = 0.0;

    double middle() const { return begin + std::ldexp(0.5, -depth); }
    Half next(bool second) const { return {depth + 1, second ? middle() : begin}; }
  };

  /// Halves what is seen of a span until it is within the tolerances, and notes where that cuts the most cells that a
  /// whole span has.
  void addCuts(const SpanPart& part, const std::array<Half, 2>& where, int deepest,
               std::array<SpanCells, 2>& cells) const {
    const bool isEnough = cells[0].cuts.size() + cells[1].cuts.size() > kEnoughCuts;
    if (isEnough || !boxOf(part).intersects(positions_.window)) return;
    const Eigen::Array2d needed = cellsNeeded(part);
    std::array<bool, 2> halves{};
    for (const std::size_t d : {0U, 1U}) {
      halves[d] = needed(static_cast<Eigen::Index>(d)) > 1.0 && where[d].depth < deepest;
      if (halves[d] && where[d].depth >= kDepthOfMost) cells[d].cuts.push_back(where[d].middle());
    }
    if (!halves[0] && !halves[1]) return;
    for (const bool secondU : {false, true}) {
      if (secondU && !halves[0]) break;
      const SpanPart ofU = halves[0] ? part.half(true, secondU) : part;
      for (const bool secondV : {false, true}) {
        if (secondV && !halves[1]) break;
        addCuts(
            halves[1] ? ofU.half(false, secondV) : ofU,
            {halves[0] ? where[0].next(secondU) : where[0], halves[1] ? where[1].next(secondV) : where[1]},
            deepest, cells);
      }
    }
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

/// What is seen of a face along itself has no end of cells: beyond these a direction of a patch has none of its own.
void limitCuts(std::vector<SpanCells>& spans) {
  constexpr std::size_t kMost = 8 * kMostCellsOfPicture;
  std::size_t count = 0;
  for (const SpanCells& cells : spans) count += cells.cuts.size();
  if (count <= kMost) return;
  for (SpanCells& cells : spans) cells.cuts.clear();
}

/// The cells along an edge of a patch.
std::vector<SpanCells>& cellsAlong(Subdivision::Counts& counts, const PatchSide& edge) {
  const auto along = std::find(edge.ends.begin(), edge.ends.end(), PatchSide::End::None) - edge.ends.begin();
  return counts[edge.patch][static_cast<std::size_t>(along)];
}

/// Gives the spans along two edges in one place the finer cells. Returns whether one has changed.
bool matched(const MeshRecord& mesh, Subdivision::Counts& counts, const PatchSide& one,
             const PatchSide& other) {
  std::vector<SpanCells>&a = cellsAlong(counts, one), &b = cellsAlong(counts, other);
  if (&a == &b || a.size() != b.size()) return false;
  const bool sameWay = nodesOn(mesh, one).front() == nodesOn(mesh, other).front();
  bool changed = false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    SpanCells &ofA = a[k], &ofB = b[sameWay ? k : b.size() - 1 - k];
    const SpanCells turned = sameWay ? ofB : ofB.reversed();
    if (ofA == turned) continue;
    changed = true;
    ofA.refine(turned);
    ofB = sameWay ? ofA : ofA.reversed();
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
      counts.back().emplace_back(static_cast<std::size_t>(basisOf(direction).numSpans()));
  }
  for (const PatchSide& side : borders.surface())
    SideCells(mesh.patches[side.patch], side, displacement, positions, values).refine(counts[side.patch]);
  for (auto& patch : counts)
    for (auto& direction : patch) limitCuts(direction);
  bool changed = true;
  while (changed) {  // a row may go through many patches
    changed = false;
    for (const std::vector<PatchSide>& edges : borders.sharedEdges())
      for (std::size_t k = 1; k < edges.size(); ++k) changed |= matched(mesh, counts, edges[0], edges[k]);
  }
  return Subdivision(std::move(counts));
}

}  // namespace burnish
