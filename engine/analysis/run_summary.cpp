#include "engine/analysis/run_summary.h"

namespace burnish {

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
  archive.field("seconds.assembly", timings.assembly);
  archive.field("seconds.contact", timings.contact);
  archive.field("seconds.factorisation", timings.factorisation);
  archive.field("seconds.solve", timings.solve);
  archive.field("seconds.output", timings.output);
  archive.field("seconds.total", timings.total);
}

}  // namespace burnish
