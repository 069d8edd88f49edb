#include <fmt/format.h>

#include "engine/scene/check_context.h"
#include "engine/solver/multigrid.h"

namespace burnish::inline scene {
namespace {

void checkSteps(const CheckContext& c) {
  const auto& steps = c.scene.steps;
  for (std::size_t i = 1; i < steps.size(); ++i)
    if (c.clean("steps") && steps[i].until <= steps[i - 1].until)
      return c.report(fmt::format("steps[{}].until", i),
                      fmt::format("found {} after {}; allowed: a time after the end of the phase before.",
                                  steps[i].until, steps[i - 1].until));
}

void checkOutput(const CheckContext& c) {
  constexpr double mostFrames = 100'000;
  const double end = c.scene.steps.back().until;
  checkTimes(c, "output.times", c.scene.output.times);
  if (c.scene.output.every && c.clean("output.every") && end / *c.scene.output.every > mostFrames)
    c.report("output.every", fmt::format("found {}, which makes more than {} frames; allowed: at least {}.",
                                         *c.scene.output.every, mostFrames, end / mostFrames));
}

/// Coarser meshes are of use where a factorisation is dear.
void checkLinearSolver(const CheckContext& c) {
  if (c.scene.solver.newton.linear.name != "multigrid" || !c.clean("solver.linear")) return;
  if (!hasMultigrid())
    c.report(
        "solver.linear",
        "found multigrid, which this program was built without (BURNISH_PETSC=OFF); allowed: direct, auto.");
  else if (c.dimensionIsKnown() && c.scene.dim() == 2)
    c.report("solver.linear",
             "found multigrid in a scene of two dimensions, where a direct solver is faster at every size; "
             "allowed: direct, auto.");
}

}  // namespace

void checkTimes(const CheckContext& c, const std::string& path, const std::vector<double>& times) {
  const double end = c.scene.steps.back().until;
  for (std::size_t i = 0; i < times.size(); ++i)
    if (c.clean(path) && times[i] > end)
      c.report(fmt::format("{}[{}]", path, i),
               fmt::format("found {}; allowed: a time up to the end of the run at {}.", times[i], end));
}

void checkRun(const CheckContext& c) {
  checkSteps(c);
  checkLinearSolver(c);
  if (c.clean("steps")) checkOutput(c);
}

}  // namespace burnish::inline scene
