#include "engine/contact/segments.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace burnish::inline contact {
namespace {

/// Parts in which a span is looked at before intervals are halved.
constexpr int kParts = 8;

/// Smallest segment, and accuracy of cuts, in parts of the span.
constexpr double kSmallest = 1e-9;
constexpr double kAccuracy = 1e-15;

/// Difference of positions, in parts of the coordinates, above which two kinks are different ones.
constexpr double kSame = 1e-12;

using MaybeFoot = std::optional<Foot<2>>;

bool areOnOnePiece(const MaybeFoot& a, const MaybeFoot& b) {
  if (!a || !b) return !a && !b;
  if (a->isSmooth() != b->isSmooth()) return false;
  if (!a->isSmooth())
    return (a->point.x - b->point.x).norm() <= kSame * (a->point.x.norm() + b->point.x.norm());
  return a->point.place.face == b->point.place.face && a->point.place.span == b->point.place.span;
}

}  // namespace

std::vector<Segment> segmentsOf(double begin, double end,
                                const std::function<std::optional<Foot<2>>(double)>& footAt) {
  const double length = end - begin;
  std::vector<double> cuts{begin};
  const std::function<void(double, const MaybeFoot&, double, const MaybeFoot&)> halve =
      [&](double a, const MaybeFoot& footA, double b, const MaybeFoot& footB) {
        if (areOnOnePiece(footA, footB)) return;
        const double middle = 0.5 * (a + b);
        if (b - a <= kAccuracy * length || middle <= a || middle >= b) {
          if (b - cuts.back() > kSmallest * length && end - b > kSmallest * length) cuts.push_back(middle);
          return;
        }
        const MaybeFoot foot = footAt(middle);
        halve(a, footA, middle, foot);
        halve(middle, foot, b, footB);
      };
  // Not at the very ends, where a foot may be on either side of a knot.
  double last = begin + kSmallest * length;
  MaybeFoot lastFoot = footAt(last);
  for (int k = 1; k <= kParts; ++k) {
    const double next = k == kParts ? end - kSmallest * length : begin + length * k / kParts;
    MaybeFoot foot = footAt(next);
    halve(last, lastFoot, next, foot);
    last = next;
    lastFoot = std::move(foot);
  }
  cuts.push_back(end);
  std::vector<Segment> segments;
  for (std::size_t k = 1; k < cuts.size(); ++k) {
    const MaybeFoot foot = footAt(0.5 * (cuts[k - 1] + cuts[k]));
    segments.push_back({cuts[k - 1], cuts[k], foot ? std::optional(foot->point.place) : std::nullopt});
  }
  return segments;
}

int segmentPoints(const Patch<1, 2>& slave) {
  const int degree = slave.basis().direction(0).degree();
  const Eigen::Matrix2Xd points = slave.points();
  const Eigen::Vector2d along = points.rightCols<1>() - points.leftCols<1>();
  const Eigen::Matrix2Xd ways = points.colwise() - points.col(0);
  const double across = (along(0) * ways.row(1) - along(1) * ways.row(0)).cwiseAbs().maxCoeff();
  const auto& weights = slave.weights();
  const bool isPlain = across <= 1e-12 * along.squaredNorm() &&
                       weights.maxCoeff() - weights.minCoeff() <= 1e-12 * weights.maxCoeff();
  return isPlain ? degree + 1 : std::max(2 * degree, degree + 1);
}

}  // namespace burnish::inline contact
