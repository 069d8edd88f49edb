#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/contact/coulomb.h"

namespace burnish::inline contact {

/// Friction of all points on a partner that turns freely and in itself, as a roller or a ball does. While nothing sticks, in
/// space while most of it also has one direction, friction turns the partner with all that it has: no state is in
/// equilibrium then, and the tangent does not know how large a turn ends it. There the share of the trial traction
/// that friction has counts as constant in what turns the partner, so that a correction takes the turn with which nothing
/// slips.
template <int Dim>
class Drag {
 public:
  Drag() = default;

  /// freeTurns: unknowns of turns of the partner.
  explicit Drag(std::vector<int> freeTurns) : freeTurns_(std::move(freeTurns)) {}

  bool isPossible() const { return !freeTurns_.empty(); }
  bool isFreeTurn(int unknown) const { return std::ranges::find(freeTurns_, unknown) != freeTurns_.end(); }

  /// Counts what touches. force: of friction, in components across the normal or in space.
  template <int D>
  void add(const FrictionTraction<Dim - 1>& law, const Eigen::Vector<double, D>& force) {
    sticks_ = sticks_ || !law.slips;
    sum_.template head<D>() += force;
    all_ += force.norm();
  }

  /// slope: of a gap by a free turn, which is none of a partner that turns in itself.
  void addSlope(double slope) {
    constexpr double kNoSlope = 1e-8;
    pushes_ = pushes_ || std::abs(slope) > kNoSlope;
  }

  /// Whether what has been counted drags the partner.
  explicit operator bool() const {
    constexpr double kMost = 0.7;
    return isPossible() && !sticks_ && !pushes_ && all_ > 0.0 && (Dim == 2 || sum_.norm() > kMost * all_);
  }

 private:
  std::vector<int> freeTurns_;
  bool sticks_ = false, pushes_ = false;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  double all_ = 0.0;
};

}  // namespace burnish::inline contact
