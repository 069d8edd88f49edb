#pragma once
#include <Eigen/Dense>

#include "engine/solver/term.h"

namespace burnish {

/// A load on the body.
class LoadTerm : public Term {
 public:
  /// Forces on the displacement unknowns of the body at the last evaluated state. Their products with
  /// displacement increments are the external work.
  const Eigen::VectorXd& nodalForces() const { return forces_; }

 protected:
  Eigen::VectorXd forces_;
};

}  // namespace burnish
