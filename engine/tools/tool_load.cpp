#include "engine/tools/tool_load.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace burnish::inline tools {
namespace {

/// Largest turn of one step, radians.
constexpr double kLargestTurn = 0.2;

/// A tool whose path goes along the normal of its surface by more than this share of the way is taken down or lifted,
/// not led along the surface.
constexpr double kSteep = 0.5;

/// Share of the force that a tool carries, below which it counts as not carried.
constexpr double kNotCarried = 1e-3;

}  // namespace

ToolLoad::ToolLoad(const Tool& tool, std::array<std::function<double(double)>, kToolDofs> load,
                   double farthestWay)
    : tool_(tool), load_(std::move(load)), farthestWay_(farthestWay) {}

CouplingGroups ToolLoad::couplings() const {
  CouplingGroups groups;
  for (std::size_t dof = kTurn; dof < kAllToolDofs && steadiness_ > 0.0; ++dof)
    if (tool_.isFree(dof)) groups.push_back({tool_.unknowns[dof]});
  if (holder_) groups.push_back({tool_.unknowns[holder_->dof]});
  return groups;
}

ToolLoad::Carried ToolLoad::carriedAt(std::size_t dof, double t, double value) const {
  if (dof >= kSpin) return {0.0, steadiness_};
  const double force = load_[dof](std::max(t, 0.0));
  if (dof == kTurn) return {force / tool_.turnLength, steadiness_};
  if (!holder_ || holder_->dof != dof) return {force, 0.0};
  const double pushedBack = holder_->sign * (inHolder(dof, t) - value);
  const double resistance = holder_->stiffness * pushedBack;
  if (resistance >= holder_->sign * force) return {force, holder_->steadiness};
  return {holder_->sign * resistance, holder_->stiffness, true};
}

double ToolLoad::inHolder(std::size_t dof, double t) const {
  return tool_.followsSurface() ? 0.0 : tool_.motion[dof](std::max(t, 0.0));
}

bool ToolLoad::evaluate(double t, const Eigen::VectorXd& x, Assembly& out) {
  last_.emplace();
  time_ = t;
  carriedForce_ = 0.0;
  for (std::size_t dof = 0; dof < kAllToolDofs; ++dof) {
    if (!tool_.isFree(dof)) continue;
    const double value = (*last_)[dof] = x(tool_.unknowns[dof]);
    const double farthest = dof >= kTurn ? kLargestTurn * tool_.turnLength : farthestWay_;
    if (accepted_ && std::abs(value - (*accepted_)[dof]) > farthest) {
      runaway_ = dof;
      return false;
    }
    const Carried carried = carriedAt(dof, t, value);
    out.force(tool_.unknowns[dof]) -= carried.load;
    if (dof < kTurn) carriedForce_ = std::hypot(carriedForce_, carried.load);
    if (holder_ && holder_->dof == dof) carriesTooLittle_ = carried.isLess && holder_->mustCarry(t);
    const double slope =
        carried.slope > 0.0 && dof >= kTurn && isUnborne() ? firstTouch_->stiffness : carried.slope;
    if (out.system != nullptr && slope > 0.0)
      out.system->add({tool_.unknowns[dof]}, Eigen::MatrixXd::Constant(1, 1, slope));
  }
  return true;
}

bool ToolLoad::isUnborne() const {
  return firstTouch_ && carriedForce_ > 0.0 && firstTouch_->reaction().norm() <= kNotCarried * carriedForce_;
}

double ToolLoad::usefulPart(const Eigen::VectorXd& x, const Eigen::VectorXd& correction) const {
  if (!isUnborne()) return 1.0;
  const ToolPose pose = tool_.pose(time_, x);
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  for (std::size_t dof = 0; dof < kTurn; ++dof)
    if (tool_.isFree(dof)) way += correction(tool_.unknowns[dof]) * tool_.direction(dof, pose);
  const Eigen::Vector3d pressed = force(time_).normalized();
  const double depth = way.dot(pressed);
  const bool runsAway = (way - depth * pressed).norm() > farthestWay_;  // aside, where nothing holds it
  if (depth <= 0.0 || runsAway) return 1.0;
  return std::min(1.0, firstTouch_->depthUnder(carriedForce_, pressed, pose, x) / depth);
}

double ToolLoad::partInAir(std::size_t dof, double begin, double way, double t, Eigen::VectorXd x) const {
  constexpr int kBisections = 30;
  if (!firstTouch_) return 1.0;
  const auto touchesAfter = [&](double part) {
    x(tool_.unknowns[dof]) = begin + part * way;
    return firstTouch_->smallestGap(tool_.pose(t, x), x) < 0.0;
  };
  if (!touchesAfter(1.0)) return 1.0;
  double low = 0.0, high = 1.0;
  for (int k = 0; k < kBisections; ++k) {
    const double middle = 0.5 * (low + high);
    (touchesAfter(middle) ? high : low) = middle;
  }
  return low;
}

bool ToolLoad::isInAir(double t, const Eigen::VectorXd& x) const {
  if (!holder_) return false;
  const Carried carried = carriedAt(holder_->dof, t, x(tool_.unknowns[holder_->dof]));
  return carried.isLess &&
         std::abs(carried.load) < kNotCarried * std::abs(load_[holder_->dof](std::max(t, 0.0)));
}

void ToolLoad::takeAlong(double from, double to, Eigen::VectorXd& x) const {
  const ToolPose before = tool_.pose(from), after = tool_.pose(to);
  Eigen::Vector3d way = after.displacement - before.displacement;
  if (isInAir(from, x)) {
    const std::size_t dof = holder_->dof;
    const double whole = way.dot(tool_.direction(dof, after));
    double& value = x(tool_.unknowns[dof]);
    if (tool_.followsSurface()) value -= whole;  // counted from where the holder is
    value += partInAir(dof, value, whole, to, x) * whole;
    return;
  }
  if (tool_.followsSurface())
    if (const double whole = way.dot(after.normal); std::abs(whole) > kSteep * way.norm())
      x(tool_.unknowns[kNormal]) -= whole;  // the body keeps it where it is
  const bool turns = tool_.isFree(kTurn) && steadiness_ > 0.0;
  Eigen::Vector3d pressed = force(from);
  if (!(turns || tool_.spins()) || pressed.isZero(0.0)) return;
  pressed.normalize();
  for (std::size_t dof = 0; dof < kTurn; ++dof) {
    const Eigen::Vector3d direction = tool_.direction(dof, after);
    if (tool_.isFree(dof)) way -= way.dot(direction) * direction;
  }
  const double far = 2.0 * (farthestWay_ + tool_.shape.halfThickness()),
               radius = far - tool_.shape.query(tool_.pivot + far * pressed).gap;
  if (!(radius > 0.0)) return;
  const Eigen::Vector3d turned = tool_.turnLength / radius * way.cross(pressed);
  if (turns) x(tool_.unknowns[kTurn]) += tool_.axis.dot(turned);
  for (std::size_t d = 0; d < kSpins && tool_.spins(); ++d)
    x(tool_.unknowns[kSpin + d]) += turned(static_cast<Eigen::Index>(d));
}

void ToolLoad::archive(StateArchive& archive) {
  std::vector<double> values;
  if (accepted_) values.assign(accepted_->begin(), accepted_->end());
  archive.field("accepted", values);
  if (!archive.restores()) return;
  accepted_.reset();
  if (values.size() == kAllToolDofs) std::ranges::copy(values, accepted_.emplace().begin());
}

Eigen::Vector3d ToolLoad::force(double t) const {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  const ToolPose pose = tool_.pose(t);
  for (std::size_t dof = 0; dof < kTurn; ++dof)
    if (load_[dof]) force += forceAlong(dof, t) * tool_.direction(dof, pose);
  return force;
}

}  // namespace burnish::inline tools
