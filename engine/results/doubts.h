#pragma once
#include <array>
#include <cstddef>
#include <string>

#include "engine/core/state_archive.h"

/// What makes the results of a run doubtful. docs/doubts.md explains the conditions.
namespace burnish::inline results {

/// Conditions of any scene, in the order in which they are told.
enum class Condition : std::size_t {
  Penetration,    ///< point-wise, per knot span or tool radius
  SmallJ,         ///< a mesh near to folding
  LostContact,    ///< too few control points carry a contact
  CrossesItself,  ///< a contact face
  NewBoundary,    ///< of a new mesh, apart from the old one
  InsideTheBody,  ///< a tool that presses on a face from the body's side
  Balance,        ///< of work and energies
  Unstable,       ///< equilibrium
  Stabilisation,  ///< carries a share of the forces
  CoarsePath,     ///< too few knot spans under a tool on its path
};
inline constexpr std::size_t kConditions = 10;

/// The limit of a condition: shares of a knot span (Penetration), of the body's size (NewBoundary), of a
/// pair's force (InsideTheBody), of the work done (Balance) and of the largest force (Stabilisation); a
/// volume ratio (SmallJ); a number of control points (LostContact), of directions (Unstable) and of knot spans over the
/// width of a contact (CoarsePath).
double limitOf(Condition condition);

/// The other limit of penetration: a share of the tool's radius.
inline constexpr double kDoubtfulRadiusShare = 0.01;

/// The limit of `LostContact` in words: "fewer than three control points".
std::string fewControlPoints();

/// A share in words: 0.1 as "a tenth", others in per cent.
std::string shareText(double share);

/// For how long a condition held, and how badly.
struct Doubt {
  int steps = 0;  ///< 0: never
  double firstTime = 0.0;
  double worst = 0.0;      ///< largest value while it held; what it measures is the condition's business
  double worstTime = 0.0;  ///< of that value
  double lastTime = 0.0;   ///< at which it held

  /// Takes in a state in which the condition holds.
  void note(double time, double value = 0.0);

  void archive(StateArchive& archive);
};

/// What a scene has that sentences depend on.
struct SceneTraits {
  bool rezones = false;
  bool touchesItself = false;
};

/// What a condition means, and its limit.
std::string sentenceOf(Condition condition, const SceneTraits& scene);

/// How bad a condition was at its worst, and what would do; empty where the sentence says it all.
std::string detailOf(Condition condition, const Doubt& doubt);

/// Difference between the work done on the body and what was found of it, energies and dissipated work, over
/// the larger of both; over the largest energy before where they are less, as at the end of a run that lets go of
/// the body: the sums of work keep the errors of what went in and out.
double imbalanceOf(double found, double done, double largestEnergy);

}  // namespace burnish::inline results
