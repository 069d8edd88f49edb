#include "engine/analysis/tip_watch.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace burnish::inline analysis {
namespace {

/// Points per span and direction, between which a tip cannot hide.
template <int Dim>
constexpr int kSamples = Dim == 2 ? 24 : 10;

/// Shares of a knot span: how deep a tip may be, and how far its point is looked around for.
constexpr double kDeepSpanShare = 0.01;
constexpr double kLookSpanShare = 0.25;

/// Normals on both sides of a look that differ by more mean a radius r below a knot span h: |Δn| = 2·0.25
/// h/r.
constexpr double kSharp = 2.0 * kLookSpanShare;

/// Largest difference of the tool's normals at opposite points at a distance around a point.
template <int Dim>
double normalJump(const Tool& tool, const ToolPose& pose, const Eigen::Vector3d& point, double distance) {
  const Eigen::Vector3d n = tool.query(pose, point).normal.normalized();
  const Eigen::Vector3d first = Dim == 2 ? Eigen::Vector3d::UnitZ().cross(n) : n.unitOrthogonal();
  const auto jump = [&](const Eigen::Vector3d& tangent) {
    return (tool.query(pose, point + distance * tangent).normal -
            tool.query(pose, point - distance * tangent).normal)
        .norm();
  };
  return Dim == 2 ? jump(first) : std::max(jump(first), jump(n.cross(first)));
}

struct DeepestPoint {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  double gap = std::numeric_limits<double>::infinity();
};

/// positions: Dim x points.
template <int Dim>
DeepestPoint deepestPoint(const Tool& tool, const ToolPose& pose, const Eigen::MatrixXd& positions) {
  DeepestPoint deepest;
  for (Eigen::Index q = 0; q < positions.cols(); ++q) {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    point.head<Dim>() = positions.col(q);
    if (const double gap = tool.query(pose, point).gap; gap < deepest.gap) deepest = {point, gap};
  }
  return deepest;
}

}  // namespace

template <int Dim>
TipWatch<Dim>::TipWatch(const Model<Dim>& model) : model_(model) {
  for (const auto& pair : model.contacts())
    samples_.emplace_back(model.body(), pair.place.patch, pair.place.face, kSamples<Dim>);
}

template <int Dim>
std::vector<FoundTip> TipWatch<Dim>::tips(const std::vector<ToolPose>& poses,
                                          const Eigen::VectorXd& x) const {
  std::vector<FoundTip> tips;
  for (std::size_t k = 0; k < samples_.size(); ++k)
    tips.push_back(tip(k, poses[model_.contacts()[k].tool], x));
  return tips;
}

template <int Dim>
FoundTip TipWatch<Dim>::tip(std::size_t pair, const ToolPose& pose, const Eigen::VectorXd& x) const {
  const ContactPair<Dim>& contact = model_.contacts()[pair];
  const Tool& tool = *model_.tools()[contact.tool];
  for (std::size_t e = 0; e < samples_[pair].spans().size(); ++e) {
    const auto& coarse = contact.term->face().spans()[e];
    const auto& span = samples_[pair].spans()[e];
    if (contact.term->state().gap.segment(coarse.firstPoint, coarse.weights.size()).minCoeff() > span.size)
      continue;
    const auto deepest = deepestPoint<Dim>(tool, pose, samples_[pair].positions(span, x));
    const double jump = normalJump<Dim>(tool, pose, deepest.x, kLookSpanShare * span.size);
    if (deepest.gap > -kDeepSpanShare * span.size || jump < kSharp) continue;
    return {-deepest.gap, 2.0 * std::asin(std::min(1.0, 0.5 * jump)), span.size};
  }
  return {};
}

template <int Dim>
std::string TipWatch<Dim>::sentence(std::size_t pair, const FoundTip& tip) const {
  const ContactPair<Dim>& contact = model_.contacts()[pair];
  return fmt::format(
      "tool '{}' is {:.2g} deep in face {} with a tip or edge too sharp for the mesh, it turns by {:.0f} "
      "degrees within half a knot span ({:.2g}); round it by more than a knot span (radius, of facets "
      "smoothing), or refine the mesh there",
      model_.tools()[contact.tool]->name, tip.depth, model_.faces().textOf(contact.place),
      tip.turn * 180.0 / std::numbers::pi, 0.5 * tip.span);
}

template class TipWatch<2>;
template class TipWatch<3>;

}  // namespace burnish::inline analysis
