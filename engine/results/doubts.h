#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "engine/core/state_archive.h"
#include "engine/results/run_account.h"

namespace burnish {

/// Conditions that make the results of any scene doubtful.
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
  Count
};

/// Limits of the conditions.
inline constexpr double kDoubtfulSpanShare = 0.1;     ///< of a knot span: penetration
inline constexpr double kDoubtfulRadiusShare = 0.01;  ///< of a tool's radius: penetration
inline constexpr double kDoubtfulJ = 0.05;
inline constexpr double kDoubtfulBoundary = 0.005;      ///< of the body's size
inline constexpr double kDoubtfulInside = 0.1;          ///< of a pair's force
inline constexpr double kDoubtfulBalance = 0.1;         ///< of the work done
inline constexpr double kDoubtfulStabilisation = 0.01;  ///< of the largest force

/// A condition, for how long it held, and how badly.
struct Doubt {
  std::string what;
  double firstTime = 0.0;
  int steps = 0;           ///< 0: never
  double worst = 0.0;      ///< largest value while it held; what it measures is the condition's business
  double worstTime = 0.0;  ///< of that value
  double lastTime = 0.0;   ///< at which it held

  /// Takes in a state in which the condition holds.
  void note(double time, double value);
};

/// Saves or restores how long conditions held, and how badly.
void archiveDoubts(StateArchive& archive, const char* name, std::vector<Doubt>& doubts);

/// The conditions of any scene, in their order.
std::vector<Doubt> commonDoubts(bool rezones, bool touchesItself);

/// How bad a condition was at its worst, and what would do; empty where the sentence says it all.
std::string detailOf(Condition condition, const Doubt& doubt);

/// Difference between the work done on the body and what was found of it, energies and dissipated work, over
/// the larger of both; over a hundredth of the largest energy before where they are less, as at the end of a
/// run that lets go of the body.
double imbalanceOf(double found, double done, double largestEnergy);

}  // namespace burnish
