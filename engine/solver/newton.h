#pragma once
#include <Eigen/Dense>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engine/solver/linear_solver.h"
#include "engine/solver/sparse_system.h"
#include "engine/solver/term.h"

namespace burnish {

struct NewtonOptions {
  double tolerance = 1e-9;             ///< of the residual forces, relative to the largest force of a term
  double constraintTolerance = 1e-12;  ///< of the averaged gap, relative to the body's size
  int maxIterations = 25;
  int maxBacktracks = 12;  ///< halvings of a correction that leads to an inadmissible state
};

/// How residuals are measured. Unknowns 0 … numForces-1 are displacement components whose residuals are
/// forces; the others are multipliers whose residuals are constraints, each with a scale of its own (A_A L).
struct ResidualScales {
  int numForces = 0;
  double forceFloor = 0.0;      ///< smallest force that counts as a reference: 1e-9 E L (E L² in 3D)
  Eigen::VectorXd constraints;  ///< one per multiplier
};

enum class NewtonOutcome { Converged, Inadmissible, Singular, TooManyIterations, NotFinite };

/// One sentence fragment for messages: "the residual did not fall below the tolerance", …
std::string describe(NewtonOutcome outcome);

struct NewtonReport {
  NewtonOutcome outcome = NewtonOutcome::TooManyIterations;
  int iterations = 0;  ///< corrections taken
  int backtracks = 0;
  double residual = std::numeric_limits<double>::infinity();  ///< last relative force residual
  double roundOff = 0.0;  ///< relative residual that round-off alone explains
  double constraint = std::numeric_limits<double>::infinity();  ///< last constraint residual over L
  std::vector<double> history;  ///< relative force residual before each correction and at the end
};

/// Seconds spent in the parts of the iteration.
struct NewtonTimings {
  std::vector<double> terms;  ///< per term: evaluation and assembly
  double factorisation = 0.0;
  double solve = 0.0;
  long iterations = 0;
};

/// Newton's method with the consistent tangent for a sum of terms. Knows residuals and tangents, no physics.
class Newton {
 public:
  /// `prescribed`: one flag per unknown. The terms must outlive the object.
  Newton(std::vector<Term*> terms, std::vector<bool> prescribed, ResidualScales scales, MatrixKind kind,
         NewtonOptions options);

  /// Solves at time t from the start x. Prescribed unknowns go to the values they have in `target` (their
  /// other entries are ignored) along with the first correction, so that an admissible start stays
  /// admissible. x holds the last iterate on return, whatever the outcome; the terms hold its trial history.
  NewtonReport solve(double t, const Eigen::VectorXd& target, Eigen::VectorXd& x);

  /// Force vectors of the terms at the last evaluated state.
  const Eigen::VectorXd& force(std::size_t term) const { return forces_[term]; }

  const SparseSystem& system() const { return system_; }
  LinearSolver& linearSolver() { return *linear_; }
  const NewtonTimings& timings() const { return timings_; }

 private:
  bool evaluate(double t, const Eigen::VectorXd& x);
  void measure(const Eigen::VectorXd& x, bool prescribedReached, NewtonReport& report);
  bool isConverged(const NewtonReport& report) const;

  std::vector<Term*> terms_;
  ResidualScales scales_;
  NewtonOptions options_;
  SparseSystem system_;
  std::unique_ptr<LinearSolver> linear_;
  std::vector<Eigen::VectorXd> forces_;
  NewtonTimings timings_;
};

}  // namespace burnish
