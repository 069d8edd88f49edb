#pragma once
#include <optional>
#include <string>
#include <vector>

/// How the solver works. Fields that a scene may set are described; the others are for tests.
namespace burnish::inline solver {

/// Names of all linear solvers.
std::vector<std::string> linearSolverNames();

struct LinearSolverOptions {
  std::string name = "direct";  ///< one of `linearSolverNames()`

  /// Of iterative methods: reduction of the residual of a linear system; as much as Newton's method can use when
  /// left out.
  std::optional<double> tolerance;
};

template <class Visitor>
void describe(Visitor& v, LinearSolverOptions& s) {
  v.field(
      "linear", s.name, {.choices = linearSolverNames()},
      "How linear systems of equations are solved: by sparse factors (direct), by conjugate gradients or GMRES "
      "with multigrid on coarser meshes (three dimensions), or by whichever is faster at this size (auto).");
  v.field(
      "linear_tolerance", s.tolerance, {.atLeast = 1e-14, .atMost = 0.1},
      "Reduction of the residual of a linear system by multigrid; as much as Newton's method can use when left "
      "out.");
}

struct NewtonOptions {
  double tolerance = 1e-9;             ///< of the residual forces, relative to the largest force of a term
  double constraintTolerance = 1e-12;  ///< of the averaged gap, relative to the body's size
  double turnTolerance = 1e-10;        ///< of moments on free turns, as far as one more correction reaches it
  int maxIterations = 25;              ///< per step, then the step is cut

  /// Halvings of a correction that leads to an inadmissible state (J <= 0, a failed return map).
  int maxBacktracks = 12;

  /// Line search by need: after `freeIterations` corrections, in which plastic flow and the contact set find
  /// themselves, a correction that makes the residual grow is halved up to `maxShortenings` times, unless the
  /// residual stays below `harmlessResidual`.
  int freeIterations = 2;
  int maxShortenings = 3;
  double harmlessResidual = 0.02;

  /// An attempt is given up after so many iterations in a row that are out of all balance.
  int divergedIterations = 3;
  double divergedResidual = 0.9;

  LinearSolverOptions linear{};
};

template <class Visitor>
void describe(Visitor& v, NewtonOptions& s) {
  v.field("tolerance", s.tolerance, {.atLeast = 1e-14, .atMost = 1e-3},
          "Relative residual of a converged step.");
  v.field("max_iterations", s.maxIterations, {.atLeast = 2, .atMost = 1000},
          "Newton iterations after which a step is cut.");
}

struct SteppingOptions {
  int maxCuts = 12;        ///< the smallest step is the nominal one / 2^maxCuts
  int easyIterations = 8;  ///< a step that needs no more counts as easy; after two of them the step doubles
};

template <class Visitor>
void describe(Visitor& v, SteppingOptions& s) {
  v.field("max_cuts", s.maxCuts, {.atLeast = 0, .atMost = 30},
          "The smallest step is the nominal one halved so many times.");
}

/// Newton's method and the control of the step size, as a scene sets them.
struct SolverOptions {
  NewtonOptions newton;
  SteppingOptions stepping;
};

template <class Visitor>
void describe(Visitor& v, SolverOptions& s) {
  describe(v, s.newton);
  describe(v, s.stepping);
  describe(v, s.newton.linear);
}

}  // namespace burnish::inline solver
