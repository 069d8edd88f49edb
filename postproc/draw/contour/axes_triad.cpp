#include "postproc/draw/contour/axes_triad.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace burnish {
namespace {

using Eigen::Vector2d;

// Measures as parts of the text size.
constexpr double kAxisLength = 2.0, kAxisHead = 0.6, kAxisHeadHalfWidth = 0.2, kBeyondTip = 0.55,
                 kNameSize = 0.85, kAxisEdge = 0.25;

constexpr double kShortestAxis = 0.15;  // of an arrow that lies in the picture

/// The directions from the one that points away from the eye most.
std::array<Eigen::Index, 3> fromBackToFront(const ViewAxes& axes) {
  const Eigen::Vector3d towardsEye = axes.row(0).cross(axes.row(1)).transpose();
  std::array<Eigen::Index, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return towardsEye(a) < towardsEye(b); });
  return order;
}

}  // namespace

void drawAxesTriad(FlatShapes& shapes, Overlay& overlay, const ViewAxes& axes, const Vector2d& corner,
                   double textSize, const Theme& theme) {
  const TextStyle style{kNameSize * textSize, theme.ink, theme.font};
  // Arrows and names go as far to the left and down as they must.
  const Vector2d low = axes.rowwise().minCoeff().cwiseMin(0.0),
                 reach = (kAxisLength + kBeyondTip) * textSize * low;
  const Vector2d origin = corner - reach + Vector2d::Constant(kAxisEdge * textSize);
  for (const Eigen::Index d : fromBackToFront(axes)) {
    const Vector2d along = axes.col(d);
    const double length = along.norm();
    if (length < kShortestAxis) continue;
    const Vector2d tip = origin + kAxisLength * textSize * along, direction = along / length,
                   across(-direction.y(), direction.x());
    const Vector2d neck = tip - std::min(kAxisHead, 0.7 * kAxisLength * length) * textSize * direction,
                   half = kAxisHeadHalfWidth * textSize * across;
    shapes.addSegments({origin, neck}, std::max(1.0, textSize / 14.0), theme.ink);
    shapes.addConvexPolygon({tip, neck + half, neck - half}, theme.ink);
    const Vector2d name = tip + kBeyondTip * textSize * direction;
    overlay.addText({{std::string(1, "xyz"[d])}}, name - Vector2d(0.0, 0.35 * capitalHeight(style)), style,
                    Overlay::Anchor::Middle);
  }
}

}  // namespace burnish
