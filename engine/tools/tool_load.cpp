#include "engine/tools/tool_load.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace burnish {
namespace {

/// Largest turn of one step, radians.
constexpr double kLargestTurn = 0.2;

}  // namespace

ToolLoad::ToolLoad(const Tool& tool, std::array<std::function<double(double)>, kToolWays> load)
    : tool_(tool), load_(std::move(load)) {}

bool ToolLoad::evaluate(double t, const Eigen::VectorXd& x, Assembly& out) {
  last_.emplace();
  for (std::size_t way = 0; way < kToolWays; ++way) {
    if (!tool_.isFree(way)) continue;
    const double value = (*last_)[way] = x(tool_.unknowns[way]);
    const double farthest = (way == kTurn ? kLargestTurn : 1.0) * tool_.turnLength;
    if (accepted_ && std::abs(value - (*accepted_)[way]) > farthest) {
      runaway_ = way;
      return false;
    }
    out.force(tool_.unknowns[way]) -= load_[way](std::max(t, 0.0)) / (way == kTurn ? tool_.turnLength : 1.0);
  }
  return true;
}

void ToolLoad::archive(StateArchive& archive) {
  std::vector<double> values;
  if (accepted_) values.assign(accepted_->begin(), accepted_->end());
  archive.field("accepted", values);
  if (!archive.restores()) return;
  accepted_.reset();
  if (values.size() == kToolWays) std::ranges::copy(values, accepted_.emplace().begin());
}

Eigen::Vector3d ToolLoad::force(double t) const {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (std::size_t way = 0; way < kTurn; ++way)
    if (load_[way]) force(static_cast<Eigen::Index>(way)) = load_[way](std::max(t, 0.0));
  return force;
}

}  // namespace burnish
