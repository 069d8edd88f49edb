#include "engine/tools/tool_path.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace burnish::inline tools {
namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;

/// Share of the force with which a tool with a ramp touches.
constexpr double kTouchingShare = 0.05;

}  // namespace

ToolPath::ToolPath(const PathSpec& spec, const Eigen::Vector3d& pivot)
    : speed_(spec.speed),
      begin_(spec.begin),
      rampTime_(spec.ramp / spec.speed),
      clearance_(spec.clearance),
      pivot_(pivot) {
  std::visit([this](const auto& course) { lay(course); }, spec.course);
}

void ToolPath::goTo(const Eigen::Vector3d& to) {
  const double length = (to - here_).norm();
  if (length == 0.0) return;
  const double turn = legs_.empty() ? 0.0 : legs_.back().turnTo;
  legs_.push_back({end(), end() + length / speed_, here_, to, turn, turn});
  here_ = to;
}

void ToolPath::lay(const PolylinePath& path) {
  std::vector<Eigen::Vector3d> points;
  for (const auto& point : path.points) points.emplace_back(Point(point));
  here_ = points.front() + clearance_;
  goTo(points.front());
  beginPass();
  for (const auto& point : points) goTo(point);
  endPass();
  goTo(points.back() + clearance_);
}

void ToolPath::lay(const RasterPath& path) {
  here_ = path.start + clearance_;
  for (int pass = 0; pass < path.passes; ++pass) {
    const bool goesBack = path.bothWays && pass % 2 == 1;
    const Eigen::Vector3d near = path.start + pass * path.feed, far = near + path.stroke;
    const Eigen::Vector3d &from = goesBack ? far : near, &to = goesBack ? near : far;
    goTo(from + clearance_);
    goTo(from);
    beginPass();
    goTo(to);
    endPass();
    goTo(to + clearance_);
  }
}

Eigen::Vector3d ToolPath::axis() const {
  return helix_ ? Eigen::Vector3d(helix_->axis.normalized()) : Eigen::Vector3d::Zero();
}

Eigen::Vector3d ToolPath::onHelix(double turn) const {
  const Eigen::Vector3d arm = pivot_ - helix_->center;
  return Eigen::AngleAxisd(turn, axis()) * arm - arm + helix_->pitch * turn / kFullTurn * axis();
}

void ToolPath::lay(const HelixPath& path) {
  helix_ = path;
  const Eigen::Vector3d arm = pivot_ - path.center;
  const double radius = (arm - axis().dot(arm) * axis()).norm();
  const double perTurn = std::hypot(kFullTurn * radius, path.pitch) / speed_;
  here_ = clearance_;
  goTo(Eigen::Vector3d::Zero());
  for (double done = 0.0; done < path.turns;) {
    const double next = std::min(std::floor(done) + 1.0, path.turns);
    beginPass();
    const double from = kFullTurn * done, to = kFullTurn * next;
    legs_.push_back({end(), end() + (next - done) * perTurn, here_, onHelix(to), from, to, true});
    here_ = legs_.back().to;
    done = next;
    endPass();
  }
  goTo(here_ + clearance(end()));
}

const ToolPath::Leg* ToolPath::legAt(double t) const {
  const auto after = std::upper_bound(legs_.begin(), legs_.end(), t,
                                      [](double time, const Leg& leg) { return time < leg.begin; });
  return after == legs_.begin() ? nullptr : &*std::prev(after);
}

Eigen::Vector3d ToolPath::displacement(double t) const {
  const Leg* leg = legAt(t);
  if (leg == nullptr) return legs_.empty() ? here_ : legs_.front().from;
  const double share = std::min(1.0, (t - leg->begin) / (leg->end - leg->begin));
  if (leg->isHelical && share < 1.0) return onHelix(std::lerp(leg->turnFrom, leg->turnTo, share));
  return (1.0 - share) * leg->from + share * leg->to;
}

double ToolPath::turn(double t) const {
  const Leg* leg = legAt(t);
  if (leg == nullptr) return 0.0;
  return std::lerp(leg->turnFrom, leg->turnTo, std::min(1.0, (t - leg->begin) / (leg->end - leg->begin)));
}

std::vector<double> ToolPath::corners() const {
  std::vector<double> times{begin_};
  for (const Leg& leg : legs_) times.push_back(leg.end);
  if (rampTime_ == 0.0) return times;
  for (const Pass& touch : touches_) {
    times.push_back(fullForceIn(touch).begin);
    times.push_back(fullForceIn(touch).end);
  }
  return times;
}

void ToolPath::endPass() {
  Pass& pass = passes_.back();
  pass.end = end();
  if (!touches_.empty() && touches_.back().end == pass.begin)
    touches_.back().end = pass.end;
  else
    touches_.push_back(pass);
}

Eigen::Vector3d ToolPath::clearance(double t) const {
  if (!helix_) return clearance_;
  return Eigen::AngleAxisd(turn(t), axis()) * clearance_;
}

bool ToolPath::isLifted(double t) const {
  constexpr double kRounding = 1e-12;
  if (clearance_.isZero(0.0) || touches_.empty() || t < touches_.front().end) return false;
  const auto next = std::ranges::find_if(touches_, [t](const Pass& touch) { return t < touch.end; });
  if (next == touches_.end()) return true;
  const auto down = std::ranges::find_if(legs_, [&](const Leg& leg) { return leg.end == next->begin; });
  return t < down->begin * (1.0 - kRounding);
}

bool ToolPath::hasBeenLifted(double t) const {
  constexpr double kRounding = 1e-12;
  if (!isLifted(t)) return false;
  const auto last = std::ranges::find_if(touches_.rbegin(), touches_.rend(),
                                         [t](const Pass& touch) { return touch.end <= t; });
  const auto up = std::ranges::find_if(legs_, [&](const Leg& leg) { return leg.begin == last->end; });
  return up == legs_.end() || t >= up->end * (1.0 - kRounding);
}

Eigen::Vector3d ToolPath::wayAhead(double t) const {
  const auto next = std::ranges::find_if(touches_, [t](const Pass& touch) { return t < touch.end; });
  if (next == touches_.end()) return Eigen::Vector3d::Zero();
  const Leg* leg = legAt(std::max(t, next->begin));
  return leg->to - leg->from;
}

std::vector<double> ToolPath::passEnds() const {
  std::vector<double> times;
  for (const Pass& pass : passes_) times.push_back(pass.end);
  return times;
}

bool ToolPath::hasFullForce(double t) const {
  constexpr double kRounding = 1e-12;
  return std::ranges::any_of(touches_, [&](const Pass& touch) {
    const auto [begin, end] = fullForceIn(touch);
    return t >= begin * (1.0 - kRounding) && t <= end * (1.0 + kRounding);
  });
}

double ToolPath::forceShare(double t) const {
  if (rampTime_ == 0.0) return 1.0;
  const auto touch =
      std::ranges::find_if(touches_, [&](const Pass& one) { return t >= one.begin && t <= one.end; });
  if (touch == touches_.end()) return kTouchingShare;
  const double fromEnds = std::min(t - touch->begin, touch->end - t);
  return std::lerp(kTouchingShare, 1.0, std::min(1.0, fromEnds / rampTime_));
}

}  // namespace burnish::inline tools
