#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <utility>

#include "engine/solver/term.h"
#include "engine/tools/tool.h"

namespace burnish::inline tools {

/// Forces and the moment that a tool carries in its free degrees of freedom.
///
/// A tool whose path lifts it sits in a holder that follows the path and presses it on with a force F, like that of
/// a machine: in the air it is where the path takes it; on the body it is pushed back into the holder, which resists
/// with the stiffness k, until it carries F, and then it finds its depth by itself. With u, the way that it is pushed
/// back, what it carries is
///
///     P = min(F, k u).
class ToolLoad final : public Term {
 public:
  /// load: per degree of freedom, in time; empty for those that are prescribed. A ball that spins carries no moment.
  /// farthestWay: the longest displacement of one step. The tool must outlive the term.
  ToolLoad(const Tool& tool, std::array<std::function<double(double)>, kToolDofs> load, double farthestWay);

  CouplingGroups couplings() const override;

  /// For a tool whose shape moves in itself when it turns, so that friction alone resists: while nothing rubs, its
  /// turns stay as they are. To be called before the couplings are asked for. stiffness: of the unknowns of turns, in
  /// the tangent alone, so small that it does not matter beside that of any contact.
  void steadyTurns(double stiffness) { steadiness_ = stiffness; }

  /// A degree of freedom in which the tool sits in a holder at the place of its prescribed motion.
  struct Holder {
    std::size_t dof;
    double sign;                            ///< of the forces that press the tool on: 1 or -1
    std::function<bool(double)> mustCarry;  ///< whether the tool is to carry F at a time
    double stiffness = 0.0;                 ///< k

    /// Of the unknown in the tangent while the tool carries F, so small that it does not matter beside any contact.
    double steadiness = 0.0;
  };

  /// Until its contact bears a tool, no tangent says how deep its force presses it, nor how friction turns it:
  /// corrections take it no deeper than depthUnder says for a force, and turns are held.
  struct FirstTouch {
    /// direction: of the force
    std::function<double(double force, const Eigen::Vector3d& direction, const ToolPose&,
                         const Eigen::VectorXd& x)>
        depthUnder;
    std::function<double(const ToolPose&, const Eigen::VectorXd& x)> smallestGap;
    std::function<Eigen::Vector3d()> reaction;  ///< of the body on the tool in the last evaluated state
    double stiffness = 0.0;                     ///< with which turns are held, in the tangent alone
  };
  void setFirstTouch(FirstTouch firstTouch) { firstTouch_ = std::move(firstTouch); }

  /// To be called before the couplings are asked for.
  void setHolder(Holder holder) { holder_ = std::move(holder); }
  std::optional<Holder>& holder() { return holder_; }

  /// Not admissible where a free degree of freedom has moved so far since the last accepted state that
  /// Newton's linearisation says nothing about the place it has come to.
  bool evaluate(double t, const Eigen::VectorXd& x, Assembly& out) override;

  double usefulPart(const Eigen::VectorXd& x, const Eigen::VectorXd& correction) const override;

  /// A tool that its body does not push back goes with its holder until it touches the body; a roller or ball
  /// that its force presses on the body rolls.
  void takeAlong(double from, double to, Eigen::VectorXd& x) const override;

  void accept() override {
    accepted_ = last_;
    runaway_.reset();
  }
  void archive(StateArchive& archive) override;

  /// The degree of freedom, if there is one, for which `evaluate` has refused a state since the last accepted
  /// one.
  std::optional<std::size_t> runaway() const { return runaway_; }

  /// Whether the tool was to carry F in the last evaluation, but was not pushed back far enough.
  bool carriesTooLittle() const { return carriesTooLittle_; }

  /// Force that the tool carries at time t, or F of a holder; zero in prescribed degrees of freedom; that of t = 0
  /// before.
  Eigen::Vector3d force(double t) const;

  /// The same along one of the free displacements.
  double forceAlong(std::size_t dof, double t) const { return load_[dof](std::max(t, 0.0)); }

  const Tool& tool() const { return tool_; }

 private:
  const Tool& tool_;
  std::array<std::function<double(double)>, kToolDofs> load_;
  /// What the tool carries in a degree of freedom, how that falls with its unknown, and whether that is less than F.
  struct Carried {
    double load = 0.0, slope = 0.0;
    bool isLess = false;
  };
  Carried carriedAt(std::size_t dof, double t, double value) const;

  /// Whether no contact bears the tool yet in the last evaluated state.
  bool isUnborne() const;

  /// Value of a displacement with which the tool is where its holder has it at time t.
  double inHolder(std::size_t dof, double t) const;

  /// Part of a way along a degree of freedom, from the value `begin` until the time t, after which a tool in the air
  /// touches; x: unknowns.
  double partInAir(std::size_t dof, double begin, double way, double t, Eigen::VectorXd x) const;

  /// Whether the tool is in its holder as if there were no body.
  bool isInAir(double t, const Eigen::VectorXd& x) const;

  using Values = std::array<double, kAllToolDofs>;
  std::optional<Values> accepted_, last_;  ///< of the free unknowns
  std::optional<std::size_t> runaway_;
  double farthestWay_;
  double steadiness_ = 0.0;
  std::optional<Holder> holder_;
  bool carriesTooLittle_ = false;
  double time_ = 0.0, carriedForce_ = 0.0;  ///< of the last evaluated state
  std::optional<FirstTouch> firstTouch_;
};

}  // namespace burnish::inline tools
