#pragma once
#include <Eigen/Dense>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/solver/hierarchy.h"
#include "engine/solver/inertia.h"
#include "engine/solver/linear_solver.h"
#include "engine/solver/solver_options.h"
#include "engine/solver/sparse_system.h"
#include "engine/solver/term.h"

namespace burnish::inline solver {

/// How residuals are measured. Unknowns 0 … numForces-1 are displacement components whose residuals are
/// forces; the others are multipliers whose residuals are constraints, each with a scale of its own (A_A L).
struct ResidualScales {
  int numForces = 0;
  double forceFloor = 0.0;  ///< smallest force that counts as a reference: 1e-9 E L (E L² in 3D)
  /// Size of the spans around each displacement component: lengths below its rounding error are not resolved
  /// by the deformation gradient.
  Eigen::VectorXd spanSizes;
  Eigen::VectorXd constraints;  ///< one per multiplier

  /// Those of the forces that are moments on free turns over the length that angles are multiplied by, with that length
  /// over half the tool's thickness, 1 where that is less.
  std::vector<std::pair<int, double>> turns{};
};

enum class NewtonOutcome { Converged, Inadmissible, Singular, Diverged, TooManyIterations, NotFinite };

/// One sentence fragment for messages: "the residual did not fall below the tolerance", …
std::string describe(NewtonOutcome outcome);

struct NewtonReport {
  NewtonOutcome outcome = NewtonOutcome::TooManyIterations;
  int iterations = 0;  ///< corrections taken
  int backtracks = 0;
  bool cameFree = false;  ///< corrections were taken in part only, see `Term::usefulPart`
  double residual = std::numeric_limits<double>::infinity();    ///< last relative force residual
  double constraint = std::numeric_limits<double>::infinity();  ///< last constraint residual over L
  int worstUnknown = -1;               ///< the one with the largest residual force, -1 if there is none
  bool atRoundOff = false;             ///< converged to what rounding allows, above the relative tolerance
  std::vector<double> history;         ///< relative force residual before each correction and at the end
  std::vector<long> linearIterations;  ///< per correction; empty with a direct solver
};

/// Seconds spent in the parts of the iteration.
struct NewtonTimings {
  std::vector<double> terms;  ///< per term: evaluation and assembly
  double factorisation = 0.0;
  double solve = 0.0;
  long iterations = 0;
};

/// Which tangent the first correction uses.
enum class FirstTangent {
  Current,     ///< of the start itself; after a plastic step it is elastic and overshoots
  Remembered,  ///< of the last remembered state: knows which points flow
};

/// Newton's method with the consistent tangent for a sum of terms. Knows residuals and tangents, no physics.
class Newton {
 public:
  /// `prescribed`: one flag per unknown. hierarchy: nested spaces of the free displacement components, for
  /// solvers that need them, as several ranks do. team: that does this together. division: of terms that ranks have divided
  /// before; made here where left out. Terms and team must outlive the object.
  Newton(std::vector<Term*> terms, std::vector<bool> prescribed, ResidualScales scales, NewtonOptions options,
         std::optional<Hierarchy> hierarchy = {}, const Team& team = alone(),
         std::optional<Division> division = {});

  /// Solves at time t from the start x. Prescribed unknowns go to the values they have in `target` (their
  /// other entries are ignored) along with the first correction, so that an admissible start stays
  /// admissible. x holds the last iterate on return, whatever the outcome; the terms hold its trial history.
  NewtonReport solve(double t, const Eigen::VectorXd& target, Eigen::VectorXd& x,
                     FirstTangent first = FirstTangent::Current);

  /// From now on holds a force against those of the terms, an entry for each unknown: a state that is out of balance by it
  /// is one that is found, until it is taken away little by little. Empty: none.
  void hold(Eigen::VectorXd force) { held_ = std::move(force); }

  /// Keeps the tangent of the last evaluated state for later first corrections, unless the solver is an
  /// iterative one: what those are for is too large to be kept twice.
  void rememberTangent();
  bool remembersTangent() const { return remembered_.leading.size() > 0; }

  /// The remembered tangent, and what is counted and timed.
  void archive(StateArchive& archive);

  /// Force vectors of the terms, in their order, at the last evaluated state.
  const std::vector<Eigen::VectorXd>& forces() const { return forces_; }

  /// Of the equilibrium that was found last, see `Inertia`; none where one is not known, and of a tangent that is
  /// divided. Takes as long as a factorisation.
  int countUnstableDirections();

  /// Unknowns whose residuals are forces, the first ones.
  int numForces() const { return scales_.numForces; }

  const NewtonOptions& options() const { return options_; }
  const SparseSystem& system() const { return system_; }
  LinearSolver& linearSolver() { return *linear_; }
  const NewtonTimings& timings() const { return timings_; }

 private:
  struct Residual {
    double force = 0.0;      ///< relative
    double reference = 0.0;  ///< force that it is relative to
    double constraint = 0.0;
    double turn =
        0.0;  ///< largest moment on a free turn, relative to the same force at half the tool's thickness
    int worstUnknown = -1;
  };

  bool evaluate(double t, const Eigen::VectorXd& x);

  /// Throws `Error` if ranks do not find the same bits.
  Residual measure() const;

  /// Residual force that rounding in its own evaluation explains: 4 ε ‖|K| (|x| + h)‖, h the sizes of the
  /// spans. F = I + ∇u is rounded like a number of order one however small the displacements are.
  double roundOff(const Eigen::VectorXd& x) const;

  NewtonOutcome judge(const Residual& residual, const Eigen::VectorXd& x, NewtonReport& report) const;

  /// `correction` holds the increments of the prescribed unknowns on entry; false if the tangent is singular.
  bool findCorrection(bool isFirst, FirstTangent first, const Residual& residual,
                      Eigen::VectorXd& correction);

  /// What an iterative method has to reach for this right-hand side: residuals are weighed by what they may be
  /// in the end. reference: the force that they are relative to.
  SolveAccuracy accuracyFor(const Eigen::VectorXd& rhs, double reference);

  /// Moves x along a part of the correction, shortened as needed; false if no admissible state was found.
  bool take(double t, const Eigen::VectorXd& correction, double part, const Eigen::VectorXd& target,
            Eigen::VectorXd& x, NewtonReport& report);

  std::vector<Term*> terms_;
  ResidualScales scales_;
  NewtonOptions options_;
  std::optional<Hierarchy> hierarchy_;
  const Team& team_;
  SparseSystem system_;
  std::unique_ptr<LinearSolver> linear_;
  Inertia inertia_;
  std::vector<Eigen::VectorXd> forces_;
  Eigen::VectorXd held_;  ///< see `hold`
  /// Of an iterative solver: before the last correction, over what it may be in the end; 0 before the first.
  double weighedResidual_ = 0.0;
  SparseSystem::Entries remembered_;  ///< of a tangent; empty before the first
  NewtonTimings timings_;
  bool hasEquilibrium_ = false;  ///< whose tangent `system_` holds
};

}  // namespace burnish::inline solver
