#pragma once
#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "engine/solid/body.h"

namespace burnish::inline contact {

/// What contact with a tool and of a face with itself have in common at the last evaluated state; functions
/// are those of the face's trace.
struct FaceContactState {
  Eigen::VectorXd averageGap;  ///< g_A (34), functions
  Eigen::VectorXd lambdaHat;   ///< augmented multiplier λ̂_A <= 0 where active, 0 elsewhere, functions
  std::vector<bool> active;    ///< functions; empty for point-wise penalty
  int changes = 0;             ///< functions that became active or inactive since the evaluation before
  Eigen::VectorXd gap;         ///< point-wise gap, quadrature points
  Eigen::VectorXd pressure;    ///< nominal contact pressure >= 0 in compression, quadrature points

  int numActive() const;
  double largestPenetration() const;  ///< >= 0, over quadrature points

  /// Sets `changes`. before: `active` of the evaluation before; empty if there was none.
  void countChanges(const std::vector<bool>& before);
};

/// Quadrature points per direction and span of a contact face: twice the largest degree of its patch unless
/// a number is wanted.
template <int Dim>
int contactPoints(const Body<Dim>& body, int patch, std::optional<int> wanted);

/// A gap as an average takes it, with its first and second derivative by the gap.
struct LimitedGap {
  double value = 0.0, slope = 1.0, curvature = 0.0;
};

/// A gap in full up to a limit c > 0, above 3c as 2c, between them by a polynomial with continuous slope and
/// curvature; in full if c is infinite.
LimitedGap limitedGap(double gap, double limit);

/// Averaged slope ∫ R_A φ' dΓ / ∫ R_A dΓ of limited gaps φ(g) below which a function lies open: its averaged
/// gap does not change any more, so that no multiplier can close it. Contact of a face with itself integrates
/// over points that have a partner.
constexpr double kOpenSlope = 1e-3;

/// Tangent of an active averaged gap with the derivative D: ε/A_A D Dᵀ, then a row and a column for the
/// multiplier if there is one. stiffness: ε/A_A.
Eigen::MatrixXd averagedGapTangent(const Eigen::Ref<const Eigen::VectorXd>& D, double stiffness,
                                   bool hasMultiplier);

/// Averaged gaps are those over the weights A_A = ∫ R_A dΓ (32) of a face: throws `Error` if one is not
/// positive (Lagrange bases above degree 7, or of higher degree than 1 where an axisymmetric face meets the
/// axis).
void requireAveragedGaps(const Eigen::VectorXd& weights, bool axisymmetric);

}  // namespace burnish::inline contact
