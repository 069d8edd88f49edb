#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/solver/term.h"

namespace burnish::inline solid {

/// A load on the body.
class LoadTerm : public Term {
 public:
  /// Forces on the displacement unknowns of the body at the last evaluated state. Their products with
  /// displacement increments are the external work.
  const Eigen::VectorXd& nodalForces() const { return forces_; }

  /// Throws `FormulaError` if a formula of the load has no finite value at one of these times.
  virtual void requireFinite(const std::vector<double>& times) const = 0;

 protected:
  Eigen::VectorXd forces_;
};

}  // namespace burnish::inline solid
