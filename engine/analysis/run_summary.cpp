#include "engine/analysis/run_summary.h"

namespace burnish {
void RunTimings::archive(StateArchive& archive) {
  archive.field("assembly", assembly);
  archive.field("contact", contact);
  archive.field("factorisation", factorisation);
  archive.field("solve", solve);
  archive.field("output", output);
  archive.field("total", total);
}

void RunSummary::archive(StateArchive& archive) {
  archive.field("approach_steps", approachSteps);
  archive.field("approach_iterations", approachIterations);
  archive.field("max_iterations", maxIterations);
  archive.field("worst_residual", worstResidual);
  archive.field("worst_constraint", worstConstraint);
  archive.field("steps_at_round_off", stepsAtRoundOff);
  archive.field("frames", frames);
  archive.field("factor_non_zeros", factorNonZeros);
  archive.field("lu_factorisations", luFactorisations);
  archive.part("seconds", timings);
}

SummaryRecord makeSummaryRecord(const RunSummary& s) {
  SummaryRecord record{.program = s.program,
                       .completed = s.completed,
                       .stoppedBecause = s.stoppedBecause,
                       .advice = s.advice,
                       .doubts = s.doubts,
                       .warnings = s.warnings,
                       .idleTools = s.idleTools,
                       .reactions = s.reactions,
                       .rezonings = s.rezonings,
                       .rezoningFailure = s.rezoningFailure,
                       .numbers = {{"end_time", s.end.time},
                                   {"functions", s.functions},
                                   {"unknowns", s.unknowns},
                                   {"approach_steps", s.approachSteps},
                                   {"approach_iterations", static_cast<double>(s.approachIterations)},
                                   {"steps", s.steps},
                                   {"cut_backs", s.cuts},
                                   {"smallest_step", s.smallestStep},
                                   {"iterations", static_cast<double>(s.iterations)},
                                   {"mean_iterations", s.meanIterations},
                                   {"max_iterations", s.maxIterations},
                                   {"tolerance", s.tolerance},
                                   {"constraint_tolerance", s.constraintTolerance},
                                   {"worst_residual", s.worstResidual},
                                   {"worst_constraint", s.worstConstraint},
                                   {"steps_at_round_off", s.stepsAtRoundOff},
                                   {"contact_parameter", s.contactParameter},
                                   {"smallest_J", s.smallestJ},
                                   {"largest_penetration", s.largestPenetration},
                                   {"rezonings_failed", s.failedRezonings},
                                   {"factor_non_zeros", static_cast<double>(s.factorNonZeros)},
                                   {"lu_factorisations", static_cast<double>(s.luFactorisations)},
                                   {"seconds", s.timings.total},
                                   {"assembly_seconds", s.timings.assembly},
                                   {"contact_seconds", s.timings.contact},
                                   {"factorisation_seconds", s.timings.factorisation},
                                   {"solve_seconds", s.timings.solve},
                                   {"projection_seconds", s.timings.projection},
                                   {"output_seconds", s.timings.output}}};
  if (s.endVonMises) {
    record.numbers["von_mises_minimum"] = s.endVonMises->min;
    if (s.end.maxPlasticStrain > 0.0)
      record.numbers["plastic_strain_minimum"] = s.end.projectedPlasticStrain.min;
  }
  if (s.stabilised) {
    record.numbers["stabilised_share"] = s.end.stabilisedShare;
    record.numbers["largest_stabilised_share"] = s.largestStabilisedShare;
    record.numbers["stabilisation_work"] = s.end.stabilisationWork;
  }
  return record;
}

}  // namespace burnish
