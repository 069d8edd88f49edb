#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/solid/load_term.h"

namespace burnish::inline solid {

/// Forces of supports and tools that have let go: what one of them carried when it did goes linearly to zero, so that
/// the body is in balance at every step in between.
class ReleasedForces final : public LoadTerm {
 public:
  /// A time at which unknowns are let go, and the one at which their forces are gone.
  struct Release {
    double begin = 0.0, end = 0.0;
    std::vector<int> unknowns;
  };

  ReleasedForces(Eigen::Index numDisplacements, std::vector<Release> releases);

  /// Those of releases that begin at time t let go. force: of the other terms on the displacement unknowns there, which
  /// they have balanced.
  void letGo(double t, const Eigen::VectorXd& force);

  CouplingGroups couplings() const override { return {}; }
  bool evaluate(double t, const Eigen::VectorXd& x, Assembly& out) override;
  void requireFinite(const std::vector<double>&) const override {}
  void archive(StateArchive& archive) override;

 private:
  void takeForcesAt(double t);

  std::vector<Release> releases_;
  std::vector<Eigen::VectorXd> carried_;  ///< per release and unknown; zero before it begins
};

}  // namespace burnish::inline solid
