#include "engine/fit/separable_fit.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>
#include <utility>

namespace burnish::inline fit {
namespace {

/// Of all starts, so many are improved.
constexpr std::size_t kImproved = 40;

/// Weighted residuals and factors as functions of the shapes alone.
class Projection {
 public:
  Projection(const SeparableModel& model, const Eigen::VectorXd& values, const Eigen::VectorXd& weights)
      : model_(model), values_(values.cwiseProduct(weights)), weights_(weights) {}

  SeparableFit at(const Eigen::VectorXd& shapes) const {
    const Eigen::MatrixXd functions = weights_.asDiagonal() * model_.functions(shapes);
    SeparableFit fit{functions.colPivHouseholderQr().solve(values_), shapes, {}};
    fit.residuals = functions * fit.factors - values_;
    return fit;
  }

  bool admits(const SeparableFit& fit) const {
    return fit.residuals.allFinite() && model_.admits(fit.factors, fit.shapes);
  }

  // What Eigen's solver asks for.
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };
  int inputs() const { return model_.numShapes; }
  int values() const { return static_cast<int>(values_.size()); }
  int operator()(const Eigen::VectorXd& shapes, Eigen::VectorXd& residuals) const {
    residuals = at(shapes).residuals;
    return residuals.allFinite() ? 0 : -1;
  }

 private:
  const SeparableModel& model_;
  Eigen::VectorXd values_;
  Eigen::VectorXd weights_;
};

/// Calls f with every choice of `count` starts, in increasing order.
template <class F>
void forEachChoice(const std::vector<double>& starts, int count, const F& f) {
  Eigen::VectorXd chosen(count);
  const auto choose = [&](const auto& self, int place, std::size_t from) -> void {
    if (place == count) return f(chosen);
    for (std::size_t k = from; k < starts.size(); ++k) {
      chosen[place] = starts[k];
      self(self, place + 1, k + 1);
    }
  };
  choose(choose, 0, 0);
}

SeparableFit improved(const Projection& projection, SeparableFit fit) {
  Eigen::NumericalDiff<Projection, Eigen::Central> differentiable(projection);
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Projection, Eigen::Central>> solver(differentiable);
  solver.parameters.xtol = 1e-13;
  solver.parameters.ftol = 1e-15;
  solver.parameters.maxfev = 2000;
  solver.minimize(fit.shapes);
  return projection.at(fit.shapes);
}

}  // namespace

double SeparableFit::rms() const {
  return std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size()));
}

std::optional<SeparableFit> fitSeparable(const SeparableModel& model, const Eigen::VectorXd& values,
                                         const Eigen::VectorXd& weights) {
  const Projection projection(model, values, weights);
  std::vector<SeparableFit> fits;
  forEachChoice(model.starts, model.numShapes, [&](const Eigen::VectorXd& shapes) {
    SeparableFit fit = projection.at(shapes);
    if (projection.admits(fit)) fits.push_back(std::move(fit));
  });
  std::ranges::stable_sort(fits, {}, &SeparableFit::rms);
  if (model.numShapes > 0) {
    fits.resize(std::min(fits.size(), kImproved));
    for (SeparableFit& fit : fits) fit = improved(projection, fit);
    std::erase_if(fits, [&](const SeparableFit& fit) { return !projection.admits(fit); });
    std::ranges::stable_sort(fits, {}, &SeparableFit::rms);
  }
  if (fits.empty()) return std::nullopt;
  return std::move(fits.front());
}

}  // namespace burnish::inline fit
