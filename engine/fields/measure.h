#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

namespace burnish::inline fields {

/// An accepted state of a model, at which its terms have just been evaluated.
struct MeasuredState {
  double time = 0.0;
  const Eigen::VectorXd& x;          ///< all unknowns
  const Eigen::VectorXd& bulkForce;  ///< forces of the body's stresses on the displacement unknowns
};

/// Quantities of a state that a scene asks for.
class Measure {
 public:
  virtual ~Measure() = default;
  virtual std::vector<std::string> columns() const = 0;

  /// One value per column.
  virtual std::vector<double> values(const MeasuredState& state) const = 0;
};

}  // namespace burnish::inline fields
