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

ToolLoad::ToolLoad(const Tool& tool, std::array<std::function<double(double)>, kToolDofs> load)
    : tool_(tool), load_(std::move(load)) {}

CouplingGroups ToolLoad::couplings() const {
  if (steadiness_ == 0.0) return {};
  return {{tool_.unknowns[kTurn]}};
}

bool ToolLoad::evaluate(double t, const Eigen::VectorXd& x, Assembly& out) {
  last_.emplace();
  for (std::size_t dof = 0; dof < kToolDofs; ++dof) {
    if (!tool_.isFree(dof)) continue;
    const double value = (*last_)[dof] = x(tool_.unknowns[dof]);
    const double farthest = (dof == kTurn ? kLargestTurn : 1.0) * tool_.turnLength;
    if (accepted_ && std::abs(value - (*accepted_)[dof]) > farthest) {
      runaway_ = dof;
      return false;
    }
    out.force(tool_.unknowns[dof]) -= load_[dof](std::max(t, 0.0)) / (dof == kTurn ? tool_.turnLength : 1.0);
  }
  if (out.system != nullptr && steadiness_ > 0.0)
    out.system->add(out.term, 0, Eigen::MatrixXd::Constant(1, 1, steadiness_));
  return true;
}

void ToolLoad::archive(StateArchive& archive) {
  std::vector<double> values;
  if (accepted_) values.assign(accepted_->begin(), accepted_->end());
  archive.field("accepted", values);
  if (!archive.restores()) return;
  accepted_.reset();
  if (values.size() == kToolDofs) std::ranges::copy(values, accepted_.emplace().begin());
}

Eigen::Vector3d ToolLoad::force(double t) const {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (std::size_t dof = 0; dof < kTurn; ++dof)
    if (load_[dof]) force(static_cast<Eigen::Index>(dof)) = load_[dof](std::max(t, 0.0));
  return force;
}

}  // namespace burnish
