#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/schema/rule.h"

/// What a run says about itself at its end. Each struct describes its entries in `summary.yaml`: their names,
/// order and meaning. An entry that is not required is left out when it is empty.
namespace burnish::inline results {

/// A condition that makes results doubtful from a time on.
struct DoubtRecord {
  std::string what;
  double firstTime = 0.0;
  int steps = 0;
  std::string detail{};
};

template <class Visitor>
void describe(Visitor& v, DoubtRecord& s) {
  v.field("what", s.what, {.required = true}, "The condition.");
  v.field("first_time", s.firstTime, {.required = true}, "First time at which it held.");
  v.field("steps", s.steps, {.required = true}, "Number of steps in which it held.");
  v.field("detail", s.detail, {}, "How bad it was at its worst, and what would do.");
}

/// What a support carries at the end of a run, and the most that it had to.
struct ReactionRecord {
  std::string support;
  std::string place;
  std::vector<double> force;
  std::vector<double> moment;
  double largest = 0.0;
  double largestTime = 0.0;
};

template <class Visitor>
void describe(Visitor& v, ReactionRecord& s) {
  v.field("support", s.support, {.required = true}, "Name of the support.");
  v.field("place", s.place, {.required = true}, "Where it is: \"bottom\", or \"bottom of patch rim\".");
  v.field("force", s.force, {.required = true},
          "Force of the body on the support, one component per dimension.");
  v.field("moment", s.moment, {.required = true},
          "Moment of that force about the origin: z in two dimensions, x, y, z in three; empty in "
          "axisymmetry.");
  v.field("largest", s.largest, {.required = true},
          "Magnitude of the force where it is largest, of all states from t = 0 on.");
  v.field("largest_time", s.largestTime, {.required = true}, "Time of that state.");
}

/// The body meshed anew.
struct RezoningRecord {
  double time = 0.0;
  double energyLost = 0.0;
  double gapWork = 0.0;
  double volumeDrift = 0.0;
  double boundaryError = 0.0;
  double quality = 0.0;
  double smallestSpan = 0.0;
  int iterations = 0;
};

template <class Visitor>
void describe(Visitor& v, RezoningRecord& s) {
  v.field("time", s.time, {.required = true}, "When.");
  v.field("energy_lost", s.energyLost, {.required = true},
          "Strain energy that the transfer and the new equilibrium cost.");
  v.field("gap_work", s.gapWork, {.required = true},
          "Work on the body at the resting tool, as the gaps are closed that the new mesh begins with.");
  v.field("volume_drift", s.volumeDrift, {.required = true},
          "Stress-free volume over that at the start of the run, minus one.");
  v.field("boundary_error", s.boundaryError, {.required = true},
          "Distance of the new boundary from the old one along its normal.");
  v.field("quality", s.quality, {.required = true},
          "Smallest over largest determinant of the new mesh's map.");
  v.field("smallest_span", s.smallestSpan, {.required = true},
          "Length of the smallest knot span along the contact face.");
  v.field("iterations", s.iterations, {.required = true}, "Iterations to equilibrium on the new mesh.");
}

/// Steps of a tool on a path that are chosen by the half width of its contact.
struct PathStepsRecord {
  std::string tool;
  double time = 0.0;
  double halfWidth = 0.0;
  double longest = 0.0;
};

template <class Visitor>
void describe(Visitor& v, PathStepsRecord& s) {
  v.field("tool", s.tool, {.required = true}, "Name of the tool.");
  v.field("time", s.time, {.required = true},
          "When the contact was measured, at the first full force of a pass.");
  v.field("half_width", s.halfWidth, {.required = true},
          "Half its width in two dimensions; in three the radius of a circle of its area.");
  v.field("longest", s.longest, {.required = true},
          "Longest way of the tool in a step of a pass from then on.");
}

/// Seconds by part of the program.
struct RunTimings {
  double assembly = 0.0;
  double contact = 0.0;
  double factorisation = 0.0;
  double solve = 0.0;
  double projection = 0.0;
  double output = 0.0;
  double total = 0.0;
};

/// What `summary.yaml` holds beside a result; its entries are explained in docs/results.md.
struct RunAccount {
  std::string program;  ///< as in the result's model, see `programName()`
  bool completed = false;
  std::string stoppedBecause;  ///< empty when completed
  std::string advice;          ///< empty when completed or halted
  std::vector<DoubtRecord> doubts;
  std::vector<std::string> warnings;
  std::vector<std::string> idleTools;
  std::vector<ReactionRecord> reactions;
  std::vector<PathStepsRecord> pathSteps;
  std::vector<RezoningRecord> rezonings;
  std::string rezonedBody;  ///< name of the body that is meshed anew; empty in a scene of one body
  std::string rezoningFailure;

  double endTime = 0.0;
  int functions = 0;
  int unknowns = 0;
  int approachSteps = 0;
  long approachIterations = 0;
  int steps = 0;
  int cuts = 0;
  double smallestStep = 0.0;
  long iterations = 0;
  double meanIterations = 0.0;
  int maxIterations = 0;
  double tolerance = 0.0;
  double constraintTolerance = 0.0;
  double worstResidual = 0.0;
  double worstConstraint = 0.0;
  int stepsAtRoundOff = 0;
  double contactParameter = 0.0;
  double smallestJ = 1.0;
  double largestPenetration = 0.0;
  std::optional<double> vonMisesMinimum;       ///< of a completed run
  std::optional<double> plasticStrainMinimum;  ///< of a completed run with plastic flow
  std::optional<double> stabilisedShare, largestStabilisedShare, stabilisationWork;  ///< with `stabilise`
  std::optional<double> initialStressChange;                                         ///< with `initial`
  int failedRezonings = 0;
  long factorNonZeros = 0;
  long luFactorisations = 0;
  /// Of an iterative linear solver.
  std::optional<long> linearSystems, linearIterations, linearSetUps, linearFallbacks;
  RunTimings timings;
};

template <class Visitor>
void describe(Visitor& v, RunAccount& s) {
  v.field("program", s.program, {.required = true}, "Program, its version and a digest of the engine.");
  v.field("completed", s.completed, {}, "Whether the end was reached.");
  v.field("stopped_because", s.stoppedBecause, {}, "Why not.");
  v.field("advice", s.advice, {}, "What usually helps.");
  v.field("doubts", s.doubts, {}, "Conditions that make results doubtful, by their first times.");
  v.field("warnings", s.warnings, {}, "What is probably not meant in the scene, with its keys.");
  v.field("idle_tools", s.idleTools, {}, "Tools with contact pairs that have never touched the body.");
  v.field("reactions", s.reactions, {}, "One entry for each support.");
  v.field("path_steps", s.pathSteps, {}, "One entry for each tool with `step_per_half_width`.");
  v.field("rezonings", s.rezonings, {}, "One entry for each time that the body was meshed anew.");
  v.field("rezoned_body", s.rezonedBody, {}, "Which body, if there are several.");
  v.field("rezoning_failure", s.rezoningFailure, {}, "Why the last one failed that did.");

  v.field("approach_iterations", s.approachIterations, {}, "Iterations of the approach.");
  v.field("approach_steps", s.approachSteps, {}, "Steps that brought lifted tools down before t = 0.");
  v.field("assembly_seconds", s.timings.assembly, {}, "Seconds for body and loads.");
  v.field("constraint_tolerance", s.constraintTolerance, {},
          "What averaged gaps had to reach, relative to the body's size.");
  v.field("contact_parameter", s.contactParameter, {},
          "Parameter of the first contact pair; 0 without contact.");
  v.field("contact_seconds", s.timings.contact, {}, "Seconds for contact.");
  v.field("cut_backs", s.cuts, {}, "How often a step was halved.");
  v.field("end_time", s.endTime, {}, "Time of the last converged step.");
  v.field("factor_non_zeros", s.factorNonZeros, {}, "Non-zeros of the largest factorisation.");
  v.field("factorisation_seconds", s.timings.factorisation, {}, "Seconds for factorisations.");
  v.field("functions", s.functions, {}, "Basis functions of the body.");
  v.field("initial_stress_change", s.initialStressChange, {},
          "By how much the initial stress had to change to be in equilibrium, over its largest value.");
  v.field("iterations", s.iterations, {}, "Corrections of all attempts from t = 0 on.");
  v.field("largest_penetration", s.largestPenetration, {}, "Over quadrature points and all steps.");
  v.field("largest_stabilised_share", s.largestStabilisedShare, {},
          "Largest share of the largest force that the stabilisation carried.");
  v.field("linear_fallbacks", s.linearFallbacks, {},
          "Linear systems that multigrid did not solve, so that a direct solver did.");
  v.field("linear_iterations", s.linearIterations, {}, "Iterations of linear systems solved by multigrid.");
  v.field("linear_set_ups", s.linearSetUps, {}, "How often multigrid was set up for a new tangent.");
  v.field("linear_systems", s.linearSystems, {}, "Linear systems that were left to multigrid.");
  v.field("lu_factorisations", s.luFactorisations, {}, "Tangents that were not positive definite.");
  v.field("max_iterations", s.maxIterations, {}, "Largest number of corrections of one step.");
  v.field("mean_iterations", s.meanIterations, {}, "Corrections per step.");
  v.field("output_seconds", s.timings.output, {}, "Seconds for files and what observers do with frames.");
  v.field("plastic_strain_minimum", s.plasticStrainMinimum, {},
          "Smallest value of the projected plastic strain at the end.");
  v.field("projection_seconds", s.timings.projection, {}, "Seconds for projections.");
  v.field("rezonings_failed", s.failedRezonings, {},
          "How many rezonings found no sound mesh or no equilibrium on it.");
  v.field("seconds", s.timings.total, {}, "Seconds altogether.");
  v.field("smallest_J", s.smallestJ, {}, "Over quadrature points and all steps.");
  v.field("smallest_step", s.smallestStep, {}, "The smallest step that converged.");
  v.field("solve_seconds", s.timings.solve, {}, "Seconds for solutions with a factorisation.");
  v.field("stabilisation_work", s.stabilisationWork, {}, "Work that the stabilisation took.");
  v.field("stabilised_share", s.stabilisedShare, {},
          "Share of the largest force that the stabilisation carries at the end.");
  v.field("steps", s.steps, {}, "Converged steps from t = 0 on.");
  v.field("steps_at_round_off", s.stepsAtRoundOff, {},
          "Steps that ended above the tolerance because rounding allows no less.");
  v.field("tolerance", s.tolerance, {}, "What residuals had to reach.");
  v.field("unknowns", s.unknowns, {}, "Equations of the linear systems.");
  v.field("von_mises_minimum", s.vonMisesMinimum, {},
          "Smallest value of the projected von Mises stress at the end.");
  v.field("worst_constraint", s.worstConstraint, {},
          "Largest averaged gap at the end of a step, over the body's size.");
  v.field("worst_residual", s.worstResidual, {}, "Largest relative residual at the end of a step.");
}

/// All entries that are numbers, by their names.
std::map<std::string, double> numbersOf(const RunAccount& account);

/// The names of all entries that may be numbers.
std::vector<std::string> numberNames();

}  // namespace burnish::inline results
