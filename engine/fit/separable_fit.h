#pragma once
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace burnish::inline fit {

/// A family of curves y(x) = Σ_k c_k φ_k(x; θ) for given points: linear in the factors c, not in the shapes θ.
struct SeparableModel {
  /// The functions at the points, points x factors.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& shapes)> functions;

  int numShapes = 0;

  /// Values that shapes may begin with, increasing. All shapes have the same meaning, and their order has none.
  std::vector<double> starts;

  /// Whether the factors and shapes make sense; others are passed over.
  std::function<bool(const Eigen::VectorXd& factors, const Eigen::VectorXd& shapes)> admits;
};

struct SeparableFit {
  Eigen::VectorXd factors;
  Eigen::VectorXd shapes;
  Eigen::VectorXd residuals;  ///< weighted, per point

  double rms() const;
};

/// The factors and shapes that make Σ (w (y − values))² smallest. Factors follow from shapes (variable
/// projection), so that only shapes are sought: from every choice of starts, the best of which are improved by
/// Levenberg and Marquardt's method. Nothing if the model admits none of them.
std::optional<SeparableFit> fitSeparable(const SeparableModel& model, const Eigen::VectorXd& values,
                                         const Eigen::VectorXd& weights);

}  // namespace burnish::inline fit
