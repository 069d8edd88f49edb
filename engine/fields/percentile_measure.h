#pragma once
#include <functional>
#include <utility>

#include "engine/fields/measure.h"

namespace burnish::inline fields {

/// The value below which a field is in a share of the body's volume. Unlike a largest value it does not
/// depend on a thin layer at the surface.
class PercentileMeasure final : public Measure {
 public:
  /// field: values at the quadrature points. volumes: of the points.
  PercentileMeasure(double share, std::function<Eigen::VectorXd()> field,
                    std::function<Eigen::VectorXd()> volumes)
      : share_(share), field_(std::move(field)), volumes_(std::move(volumes)) {}

  std::vector<std::string> columns() const override { return {"value"}; }
  std::vector<double> values(const MeasuredState& state) const override;

 private:
  double share_;
  std::function<Eigen::VectorXd()> field_, volumes_;
};

/// The value below which `values` are in a share (0 to 1) of the sum of the weights, between values linearly.
double weightedPercentile(const Eigen::VectorXd& values, const Eigen::VectorXd& weights, double share);

}  // namespace burnish::inline fields
