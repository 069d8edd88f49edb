#include "engine/contact/tool_load.h"

#include <utility>

namespace burnish {

ToolLoad::ToolLoad(const Tool& tool, std::array<std::function<double(double)>, kToolWays> load)
    : tool_(tool), load_(std::move(load)) {}

bool ToolLoad::evaluate(double t, const Eigen::VectorXd&, Assembly& out) {
  for (std::size_t way = 0; way < kToolWays; ++way)
    if (tool_.isFree(way))
      out.force(tool_.unknowns[way]) -= load_[way](t) / (way == kTurn ? tool_.turnLength : 1.0);
  return true;
}

Eigen::Vector3d ToolLoad::force(double t) const {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (std::size_t way = 0; way < kTurn; ++way)
    if (load_[way]) force(static_cast<Eigen::Index>(way)) = load_[way](t);
  return force;
}

}  // namespace burnish
