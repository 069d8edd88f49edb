#pragma once
#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "engine/contact/contact_options.h"
#include "engine/core/formula.h"

namespace burnish::inline contact {

/// What Coulomb's coefficient may depend on beside the pressure.
struct FrictionPlace {
  Eigen::Vector3d X;     ///< reference place
  double t = 0.0;        ///< time
  double slip = 0.0;     ///< way slipped until the accepted state
  double stretch = 1.0;  ///< area of the face over its reference area in the accepted state
};

/// The largest tangential traction, b = μ ⟨-λ̂⟩, no more than a limit; nominal, as the pressure -λ̂.
struct FrictionBound {
  double mu = 0.0;
  double muByPressure = 0.0;  ///< ∂μ/∂⟨-λ̂⟩
  double limit = std::numeric_limits<double>::infinity();
};

/// The law of friction of a face: Coulomb's coefficient, a number or a formula in the true pressure p, the
/// slip, the time t and the reference place X, Y, Z; a limit of the true shear stress; or no slip at all.
class FrictionLaw {
 public:
  /// Variables of the coefficient's formula, in the order of its values.
  static const std::vector<std::string>& variables();

  /// Throws `Error` if the formula cannot be understood.
  FrictionLaw(const ContactOptions& options, const std::vector<DefinitionSpec>& definitions);

  /// pressure: nominal, >= 0; without it a formula is not asked. Throws `FormulaError` if the coefficient is
  /// not finite, or negative.
  FrictionBound at(const FrictionPlace& place, double pressure) const;

  /// Until this time there is no friction.
  void beginAt(double time) { begin_ = time; }

  /// The coefficient, if it is one number.
  std::optional<double> coefficient() const {
    return formula_ || !std::isfinite(mu_) ? std::nullopt : std::optional(mu_);
  }

  /// Whether `FrictionPlace::stretch` is asked for.
  bool needsStretch() const { return formula_.has_value() || shearLimit_.has_value(); }

 private:
  double valueAt(const FrictionPlace& place, double truePressure) const;

  double mu_ = 0.0;                 ///< without a formula; infinite where there is no slip
  std::optional<Formula> formula_;  ///< of a coefficient that is no number
  bool dependsOnPressure_ = false;
  std::optional<double> shearLimit_;
  double begin_ = -std::numeric_limits<double>::infinity();
};

}  // namespace burnish::inline contact
