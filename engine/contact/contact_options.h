#pragma once
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "engine/core/enum_names.h"
#include "engine/core/formula.h"

namespace burnish::inline contact {

/// A gap limit that no gap reaches.
inline constexpr double kAnyGap = std::numeric_limits<double>::infinity();

enum class Enforcement {
  AugmentedLagrangian,          ///< mortar, (31)-(43): displacements and multipliers in one Newton iteration
  IntegralAugmentedLagrangian,  ///< the same with complementarity at the quadrature points
  MortarPenalty,                ///< mortar, (4)
  PointwisePenalty              ///< "knot-to-surface": penalty at every quadrature point
};

constexpr auto enumNames(std::type_identity<Enforcement>) {
  return std::array{std::pair{"augmented-lagrangian", Enforcement::AugmentedLagrangian},
                    std::pair{"integral-augmented-lagrangian", Enforcement::IntegralAugmentedLagrangian},
                    std::pair{"penalty", Enforcement::MortarPenalty},
                    std::pair{"pointwise-penalty", Enforcement::PointwisePenalty}};
}

/// Whether a method closes gaps that are averaged over the functions of the face.
constexpr bool averagesGaps(Enforcement method) {
  return method == Enforcement::AugmentedLagrangian || method == Enforcement::MortarPenalty;
}

constexpr bool isPenalty(Enforcement method) {
  return method == Enforcement::MortarPenalty || method == Enforcement::PointwisePenalty;
}

/// How contact of a face is enforced.
struct ContactOptions {
  Enforcement method = Enforcement::AugmentedLagrangian;
  std::optional<double> parameter{};      ///< ε, stress per length; see `parameterFor`
  std::optional<int> quadraturePoints{};  ///< per span and direction; 2p when left out

  /// Share of the size of a span at which gaps begin to be limited in averages (`limitedGap`); the traction
  /// at a point is λ̂ times the slope there, none from three times that on. Without it a face that turns away
  /// sharply is pressed where it is open and let into the tool beside that. Mortar methods, and pairs that do
  /// not `keepInTouch`: what is open everywhere is never active.
  std::optional<double> gapLimit{};

  std::optional<FormulaText> friction{};      ///< Coulomb's μ, see `FrictionLaw`; none without
  std::optional<double> shearLimit{};         ///< largest true shear stress of friction
  bool rough = false;                         ///< no slip where the face is pressed
  std::optional<double> frictionParameter{};  ///< ε_T, stress per length; ε when left out

  /// A coefficient of zero is none.
  bool hasFriction() const {
    return rough || (friction && friction->text.find_first_not_of("+-0.") != std::string::npos);
  }

  /// ε of a body with Young's modulus E and the largest extent L, d the mean distance of control points on
  /// the face. The answer of the augmented Lagrangian does not depend on it, that of the integral one little;
  /// penalty methods trade penetration against conditioning.
  double parameterFor(double E, double L, double d) const {
    if (parameter) return *parameter;
    switch (method) {
      case Enforcement::AugmentedLagrangian:
        return E / L;
      case Enforcement::IntegralAugmentedLagrangian:
        return E / d;
      case Enforcement::MortarPenalty:
      case Enforcement::PointwisePenalty:
        break;
    }
    return 100.0 * E / L;
  }
};

template <class Visitor>
void describeFriction(Visitor& v, ContactOptions& s) {
  v.field(
      "friction", s.friction, {},
      "Coefficient of Coulomb friction, tangential over normal traction in slip: a number, or a formula in "
      "the true pressure p, the way slip that the place has slipped before this step, the time t and the "
      "reference place X, Y, Z. No friction when left out.");
  v.field("shear_limit", s.shearLimit, {.above = 0, .unit = "stress"},
          "Largest shear stress of friction, on the deformed face; unlimited when left out.");
  v.field("rough", s.rough, {},
          "The face does not slip on the tool where it is pressed; instead of friction.");
  v.field("friction_parameter", s.frictionParameter, {.above = 0, .unit = "stress per length"},
          "Penalty or augmentation parameter of friction; parameter when left out.");
}

template <class Visitor>
void describe(Visitor& v, ContactOptions& s) {
  v.field(
      "method", s.method, {},
      "Mortar augmented Lagrangian (no penetration on average), augmented Lagrangian with contact or none "
      "at every quadrature point (smoother forces), mortar penalty, or penalty at every quadrature point.");
  v.field(
      "parameter", s.parameter, {.above = 0, .unit = "stress per length"},
      "Penalty or augmentation parameter; when left out E/L (augmented Lagrangian), E/d (integral one) or "
      "100 E/L (penalties), L the body's largest extent, d the mean distance of control points on the "
      "face. On unequal knot spans the integral one is that of the mean and goes with the reciprocal length.");
  v.field("quadrature_points", s.quadraturePoints, {.atLeast = 1, .atMost = 32},
          "Quadrature points per knot span and direction; twice the degree when left out.");
  v.field("gap_limit", s.gapLimit, {.above = 0, .atMost = 1},
          "Gaps count in averages in full up to this share of the knot span's length, then ever less; what "
          "is open by three times that counts as twice that and bears no pressure. For a face that turns "
          "away from the tool sharply, as at the lip of a chip: 0.02. All gaps count in full when left out.");
  describeFriction(v, s);
}

}  // namespace burnish::inline contact
