#include "engine/analysis/boundary_crossing.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <tuple>

namespace burnish::inline analysis {
namespace {

bool cross(const BoundaryPiece& a, const BoundaryPiece& b, double rounding) {
  const auto between = [rounding](const BoundaryPiece& line, const BoundaryPiece& other) {
    const double first = line.leftOf(other.begin), second = line.leftOf(other.end);
    return std::min(first, second) < -rounding && std::max(first, second) > rounding;
  };
  return between(a, b) && between(b, a);
}

}  // namespace

double BoundaryPiece::leftOf(const Eigen::Vector2d& x) const {
  const Eigen::Vector2d along = (end - begin).normalized(), to = x - begin;
  return along.x() * to.y() - along.y() * to.x();
}

std::optional<BoundaryCrossing> findCrossing(const std::vector<BoundaryPiece>& pieces, double rounding) {
  using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 2, const BoundaryPiece*>;
  std::vector<Box> boxes;
  for (const BoundaryPiece& piece : pieces) {
    const Eigen::Vector2d low = piece.begin.cwiseMin(piece.end), high = piece.begin.cwiseMax(piece.end);
    boxes.emplace_back(CGAL::Bbox_2(low.x(), low.y(), high.x(), high.y()), &piece);
  }
  const BoundaryPiece* first = nullptr;
  const BoundaryPiece* second = nullptr;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    if (first == nullptr && cross(*a.handle(), *b.handle(), rounding))
      std::tie(first, second) = std::minmax(a.handle(), b.handle());
  });
  if (first == nullptr) return std::nullopt;
  const double before = first->leftOf(second->begin), after = first->leftOf(second->end);
  return BoundaryCrossing{second->begin + before / (before - after) * (second->end - second->begin),
                          first->face, second->face};
}

}  // namespace burnish::inline analysis
