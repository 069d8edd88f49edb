#include "engine/tools/line_crossing.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>

namespace burnish::inline tools {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Segment = Kernel::Segment_2;
using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 2, const Segment*>;
using Pair = std::pair<std::size_t, std::size_t>;

/// So many pairs are enough: a line that fills a place over and over has one for every two of its pieces.
constexpr std::size_t kMostPairs = 10'000;

/// Ends the search.
struct Enough {};

}  // namespace

std::optional<Pair> findLineCrossing(const std::vector<Eigen::Vector2d>& points, bool closed) {
  const std::size_t n = points.size(), count = closed ? n : n - 1;
  const auto at = [&](std::size_t k) { return Kernel::Point_2(points[k % n].x(), points[k % n].y()); };
  std::vector<Segment> pieces;
  for (std::size_t k = 0; k < count; ++k) pieces.emplace_back(at(k), at(k + 1));
  std::vector<Box> boxes;
  for (const Segment& piece : pieces) boxes.emplace_back(piece.bbox(), &piece);
  std::optional<Pair> first;
  std::size_t found = 0;
  const auto look = [&](const Box& a, const Box& b) {
    const Segment* low = std::min(a.handle(), b.handle());
    const Segment* high = std::max(a.handle(), b.handle());
    const Pair pair(low - pieces.data(), high - pieces.data());
    const bool follow =
        pair.second == pair.first + 1 || (closed && pair.first == 0 && pair.second + 1 == count);
    if (follow || !CGAL::do_intersect(*low, *high)) return;
    if (!first || pair < *first) first = pair;
    if (++found == kMostPairs) throw Enough();
  };
  try {
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), look);
  } catch (const Enough&) {
  }
  return first;
}

}  // namespace burnish::inline tools
