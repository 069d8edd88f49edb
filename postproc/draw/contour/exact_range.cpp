#include "postproc/draw/contour/exact_range.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "postproc/draw/contour/field_choice.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/tensor_points.h"

namespace burnish {
namespace {

/// Halvings after which the best value found must do. A smooth field takes 50.
constexpr int kMostHalvings = 20000;

/// A part of a knot span.
struct SpanPart {
  Eigen::MatrixXd homogeneous;  ///< Bernstein coefficients times their weights, the weights in the last row
  IndexBox box;                 ///< of the coefficients
  std::size_t patch = 0;
  std::array<std::array<double, 2>, 3> parameters{};  ///< from where to where, in each direction of the patch

  Eigen::MatrixXd coefficients() const {
    return homogeneous.topRows(homogeneous.rows() - 1).array().rowwise() /
           homogeneous.bottomRows(1).row(0).array();
  }
};

/// The coefficients that are values of the field, in the corners, with their places.
template <class Act>
void forCorners(const SpanPart& span, const Act& act) {
  for (int corner = 0; corner < 8; ++corner) {
    IndexBox::Index index{};
    FieldPlace place{span.patch, {}};
    for (std::size_t d = 0; d < 3; ++d) {
      const int end = corner >> d & 1;
      index[d] = end * (span.box.extent[d] - 1);
      place.parameters[d] = span.parameters[d][static_cast<std::size_t>(end)];
    }
    act(span.box.number(index), place);
  }
}

/// Halves in one direction by de Casteljau's algorithm.
std::array<SpanPart, 2> halves(const SpanPart& span, std::size_t direction) {
  std::array<SpanPart, 2> result{span, span};
  Eigen::MatrixXd& lower = result[0].homogeneous;
  Eigen::MatrixXd& upper = result[1].homogeneous;
  int stride = 1;
  for (std::size_t d = 0; d < direction; ++d) stride *= span.box.extent[d];
  const int n = span.box.extent[direction];
  for (int first = 0; first < span.box.size(); ++first) {
    if (span.box.index(first)[direction] != 0) continue;
    const auto at = [&](int i) { return first + i * stride; };
    for (int k = 1; k < n; ++k) {
      // `upper` holds the averages of order k-1 up to where it is finished.
      for (int i = 0; i + k < n; ++i) upper.col(at(i)) = 0.5 * (upper.col(at(i)) + upper.col(at(i + 1)));
      lower.col(at(k)) = upper.col(at(0));
    }
  }
  const auto& [begin, end] = span.parameters[direction];
  result[0].parameters[direction][1] = result[1].parameters[direction][0] = 0.5 * (begin + end);
  return result;
}

/// Looks for the smallest (sign -1) or the largest value (sign +1).
class ExtremeSearch {
 public:
  ExtremeSearch(const FieldChoice& field, double sign) : field_(field), sign_(sign) {}

  /// Takes the value of a place into account.
  void offer(double value, const FieldPlace& place) {
    if (sign_ * value <= best_) return;
    best_ = sign_ * value;
    place_ = place;
  }

  /// Adds a span whose corners have been offered.
  void add(SpanPart span) {
    const double most = bound(span.coefficients());
    if (most > best_) parts_.push({most, std::move(span)});
  }

  /// tolerance: of the value.
  void find(double tolerance) {
    for (int k = 0; k < kMostHalvings && !parts_.empty(); ++k) {
      const Part part = parts_.top();
      if (part.most <= best_ + tolerance) break;
      parts_.pop();
      for (SpanPart& half : halves(part.span, longest(part.span))) {
        const Eigen::MatrixXd coefficients = half.coefficients();
        forCorners(half, [&](int corner, const FieldPlace& place) {
          offer(field_.drawnScalars(coefficients.col(corner))(0), place);
        });
        add(std::move(half));
      }
    }
  }

  double value() const { return sign_ * best_; }
  const FieldPlace& place() const { return place_; }

 private:
  struct Part {
    double most;  ///< a bound of sign times the values
    SpanPart span;
    bool operator<(const Part& other) const { return most < other.most; }
  };

  /// Of sign times the field with these coefficients: it lies in their convex hull, and the magnitude of a
  /// vector is at least its part along the middle one.
  double bound(const Eigen::MatrixXd& coefficients) const {
    if (sign_ > 0.0 || coefficients.rows() == 1)
      return (sign_ * field_.drawnScalars(coefficients)).maxCoeff();
    const Eigen::VectorXd along = coefficients.rowwise().mean().stableNormalized();
    return -std::max(0.0, (along.transpose() * coefficients).minCoeff());
  }

  /// The direction in which the coefficients differ most.
  std::size_t longest(const SpanPart& span) const {
    const Eigen::MatrixXd q = span.coefficients();
    std::array<double, 3> most{-1.0, -1.0, -1.0};
    int stride = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      for (int a = 0; a < span.box.size(); ++a)
        if (span.box.index(a)[d] + 1 < span.box.extent[d])
          most[d] = std::max(most[d], (q.col(a + stride) - q.col(a)).norm());
      stride *= span.box.extent[d];
    }
    return static_cast<std::size_t>(std::max_element(most.begin(), most.end()) - most.begin());
  }

  const FieldChoice& field_;
  double sign_;
  double best_ = -std::numeric_limits<double>::infinity();
  FieldPlace place_;
  std::priority_queue<Part> parts_;
};

/// Calls `act` with every knot span, one layer of the last direction after the other: all coefficients of a
/// body in space would be more than memory should hold.
template <class Act>
void forSpans(const MeshRecord& mesh, std::size_t number, const Eigen::MatrixXd& field, const Act& act) {
  const PatchRecord& patch = mesh.patches[number];
  std::vector<PointRow> rows;
  std::vector<int> degrees;
  std::vector<std::vector<double>> breakpoints;
  for (const DirectionRecord& direction : patch.directions) {
    const UnivariateBasis basis = basisOf(direction);
    rows.push_back(bernsteinPoints(basis));
    degrees.push_back(basis.degree());
    breakpoints.push_back(basis.breakpoints());
  }
  const PointRow last = rows.back();
  const int height = degrees.back();
  for (int layer = 0; layer + height < static_cast<int>(last.firstFunction.size()); layer += height) {
    rows.back() = neighbouring(last, layer, height + 1);
    const TensorPoints points(patch, rows);
    Eigen::MatrixXd all(field.rows() + 1, points.size());
    all.topRows(field.rows()) = points.evaluate(field) * points.weights().asDiagonal();
    all.bottomRows(1) = points.weights().transpose();
    IndexBox spans, own;
    for (std::size_t d = 0; d < degrees.size(); ++d) {
      own.extent[d] = degrees[d] + 1;
      spans.extent[d] = (points.box().extent[d] - 1) / degrees[d];
    }
    std::vector<int> columns(static_cast<std::size_t>(own.size()));
    for (int span = 0; span < spans.size(); ++span) {
      IndexBox::Index at = spans.index(span);
      for (int a = 0; a < own.size(); ++a) {
        IndexBox::Index index = own.index(a);
        for (std::size_t d = 0; d < degrees.size(); ++d) index[d] += at[d] * degrees[d];
        columns[static_cast<std::size_t>(a)] = points.box().number(index);
      }
      SpanPart part{all(Eigen::all, columns), own, number, {}};
      at[degrees.size() - 1] = layer / height;
      for (std::size_t d = 0; d < degrees.size(); ++d) {
        const auto first = static_cast<std::size_t>(at[d]);
        part.parameters[d] = {breakpoints[d][first], breakpoints[d][first + 1]};
      }
      act(std::move(part));
    }
  }
}

}  // namespace

std::optional<ExactRange> exactRange(const MeshRecord& mesh, const FieldChoice& field) {
  constexpr double kTolerance = 1e-6;
  ExtremeSearch smallest(field, -1.0), largest(field, 1.0);
  bool isFinite = true;
  // All corners first, so that few spans need to be kept.
  for (const bool keep : {false, true})
    for (std::size_t number = 0; number < mesh.patches.size(); ++number)
      forSpans(mesh, number, field.coefficients, [&](SpanPart span) {
        if (keep) {
          smallest.add(span);
          largest.add(std::move(span));
          return;
        }
        isFinite = isFinite && span.homogeneous.allFinite();
        const Eigen::MatrixXd coefficients = span.coefficients();
        forCorners(span, [&](int corner, const FieldPlace& place) {
          const double value = field.drawnScalars(coefficients.col(corner))(0);
          smallest.offer(value, place);
          largest.offer(value, place);
        });
      });
  if (!isFinite) return std::nullopt;
  const double tolerance = kTolerance * (largest.value() - smallest.value());
  smallest.find(tolerance);
  largest.find(tolerance);
  return ExactRange{{smallest.value(), largest.value()}, {smallest.place(), largest.place()}};
}

Eigen::VectorXd positionOf(const FieldPlace& place, const MeshRecord& mesh,
                           const Eigen::MatrixXd& displacement) {
  const PatchRecord& patch = mesh.patches[place.patch];
  std::vector<PointRow> rows;
  for (std::size_t d = 0; d < patch.directions.size(); ++d)
    rows.push_back(valuesAt(basisOf(patch.directions[d]), {place.parameters[d]}));
  const TensorPoints point(patch, rows);
  return point.referencePoints() + point.evaluate(displacement);
}

}  // namespace burnish
