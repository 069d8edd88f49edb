#pragma once
#include "engine/core/formula.h"
#include "engine/fields/measure.h"
#include "engine/solid/span_quadrature.h"

namespace burnish::inline fields {

/// Errors of the displacement against an exact one, relative to its norm; absolute where that is zero:
/// L2 of the displacement itself, H1 of its reference gradient.
template <int Dim>
class ErrorMeasure final : public Measure {
 public:
  /// exact: Dim formulas. Takes two more quadrature points per direction than the body.
  ErrorMeasure(const Body<Dim>& body, std::vector<Formula> exact);

  /// L2, H1
  std::vector<std::string> columns() const override { return {"L2", "H1"}; }
  std::vector<double> values(const MeasuredState& state) const override;

 private:
  Eigen::Vector<double, Dim> exactDisplacement(const Eigen::Vector3d& X, double t) const;

  /// By differences of fourth order.
  Eigen::Matrix<double, Dim, Dim> exactGradient(const Eigen::Vector3d& X, double t) const;

  SpanQuadrature<Dim> quadrature_;
  Eigen::MatrixXd nodes_;
  std::vector<Formula> exact_;
  double step_;  ///< of the differences
};

}  // namespace burnish::inline fields
