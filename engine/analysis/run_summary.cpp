#include "engine/analysis/run_summary.h"

#include <utility>

namespace burnish::inline analysis {

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
  for (const auto& [name, count] :
       {std::pair{"linear_systems", &linearSystems}, std::pair{"linear_iterations", &linearIterations},
        std::pair{"linear_set_ups", &linearSetUps}, std::pair{"linear_fallbacks", &linearFallbacks}}) {
    long soFar = count->value_or(0);
    archive.field(name, soFar);
    if (soFar > 0) *count = soFar;
  }
  archive.field("seconds.assembly", timings.assembly);
  archive.field("seconds.contact", timings.contact);
  archive.field("seconds.factorisation", timings.factorisation);
  archive.field("seconds.solve", timings.solve);
  archive.field("seconds.output", timings.output);
  archive.field("seconds.total", timings.total);
}

}  // namespace burnish::inline analysis
