#include "engine/contact/friction_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "engine/core/quoted.h"

namespace burnish::inline contact {

const std::vector<std::string>& FrictionLaw::variables() {
  static const std::vector<std::string> names{"p", "slip", "t", "X", "Y", "Z"};
  return names;
}

FrictionLaw::FrictionLaw(const ContactOptions& options, const std::vector<DefinitionSpec>& definitions)
    : shearLimit_(options.shearLimit) {
  if (options.rough) {
    mu_ = std::numeric_limits<double>::infinity();
  } else if (options.friction) {
    Formula formula(*options.friction, definitions, variables());
    const bool isNumber = std::none_of(variables().begin(), variables().end(),
                                       [&](const std::string& name) { return formula.dependsOn(name); });
    dependsOnPressure_ = formula.dependsOn("p");
    formula_ = std::move(formula);
    if (isNumber) {
      mu_ = valueAt({.X = Eigen::Vector3d::Zero()}, 1.0);
      formula_.reset();
    }
  }
}

double FrictionLaw::valueAt(const FrictionPlace& place, double truePressure) const {
  const double mu =
      formula_->at(std::array{truePressure, place.slip, place.t, place.X(0), place.X(1), place.X(2)});
  if (mu < 0.0)
    throw FormulaError(
        fmt::format("the coefficient of friction is {:.6g} at p = {:.6g}, slip = {:.6g}, t = {:.6g}, "
                    "X = {:.6g}, Y = {:.6g}, Z = {:.6g}; it has to be at least 0",
                    mu, truePressure, place.slip, place.t, place.X(0), place.X(1), place.X(2)));
  return mu;
}

FrictionBound FrictionLaw::at(const FrictionPlace& place, double pressure) const {
  // Far from rounding, and from what a third derivative would spoil.
  constexpr double kStep = 1e-5;
  if (place.t <= begin_) return {};
  FrictionBound bound{.mu = mu_};
  if (formula_ && pressure > 0.0) {
    const double p = pressure / place.stretch;
    bound.mu = valueAt(place, p);
    if (dependsOnPressure_)
      bound.muByPressure =
          (valueAt(place, (1.0 + kStep) * p) - valueAt(place, (1.0 - kStep) * p)) / (2.0 * kStep * pressure);
  }
  if (shearLimit_) bound.limit = *shearLimit_ * place.stretch;
  return bound;
}

}  // namespace burnish::inline contact
