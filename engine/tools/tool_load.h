#pragma once
#include <Eigen/Dense>
#include <array>
#include <functional>
#include <optional>

#include "engine/solver/term.h"
#include "engine/tools/tool.h"

namespace burnish {

/// Forces and the moment that a tool carries in its free degrees of freedom.
class ToolLoad final : public Term {
 public:
  /// load: per degree of freedom, in time; empty for those that are prescribed. The tool must outlive the
  /// term.
  ToolLoad(const Tool& tool, std::array<std::function<double(double)>, kToolDofs> load);

  CouplingGroups couplings() const override;

  /// For a tool whose shape moves in itself when it turns, so that friction alone resists: while nothing rubs, the
  /// turn stays as it is. To be called before the couplings are asked for. stiffness: of the unknown of the turn, in the
  /// tangent alone, so small that it does not matter beside that of any contact.
  void steadyTurn(double stiffness) { steadiness_ = stiffness; }

  /// Not admissible where a free degree of freedom has moved so far since the last accepted state that
  /// Newton's linearisation says nothing about the place it has come to.
  bool evaluate(double t, const Eigen::VectorXd& x, Assembly& out) override;

  void accept() override {
    accepted_ = last_;
    runaway_.reset();
  }
  void archive(StateArchive& archive) override;

  /// The degree of freedom, if there is one, for which `evaluate` has refused a state since the last accepted
  /// one.
  std::optional<std::size_t> runaway() const { return runaway_; }

  /// Force that the tool carries at time t, zero in prescribed degrees of freedom; that of t = 0 before.
  Eigen::Vector3d force(double t) const;

  const Tool& tool() const { return tool_; }

 private:
  const Tool& tool_;
  std::array<std::function<double(double)>, kToolDofs> load_;
  std::optional<std::array<double, kToolDofs>> accepted_, last_;  ///< values of the free unknowns
  std::optional<std::size_t> runaway_;
  double steadiness_ = 0.0;
};

}  // namespace burnish
