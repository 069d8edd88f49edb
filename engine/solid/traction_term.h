#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/core/schedule.h"
#include "engine/solid/body.h"
#include "engine/solver/term.h"

namespace burnish {

/// A dead traction on a face of a patch: force per reference area with a fixed direction, scaled by a
/// schedule.
template <int Dim>
class TractionTerm final : public Term {
 public:
  /// An empty schedule means a constant factor of 1.
  TractionTerm(const Body<Dim>& body, int patch, FaceId face, const Eigen::Vector<double, Dim>& traction,
               Schedule factor);

  CouplingGroups couplings() const override { return {}; }
  bool evaluate(double t, const Eigen::VectorXd& x, Assembly& out) override;

  /// Nodal forces at time t; their product with displacement increments is the external work.
  Eigen::VectorXd load(double t) const;

 private:
  Eigen::VectorXd unitLoad_;  ///< over the displacement unknowns of the body
  Schedule factor_;
};

}  // namespace burnish
