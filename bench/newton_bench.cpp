// One step of the elastoplastic ironing problem (49 x 25 functions) in mid-press, solved again and again on
// one core. Times are per Newton iteration: milliseconds in all, and by part; beside them what no other load
// on the machine changes: iterations, unknowns and non-zeros of the factors.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include "engine/analysis/build_model.h"
#include "engine/analysis/residual_scales.h"
#include "engine/scene/reader.h"
#include "engine/solver/stepping.h"

namespace burnish {
namespace {

void newtonIteration(benchmark::State& state, const std::string& basis, int degree) {
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  const Scene scene = readScene(std::string(BURNISH_SOURCE_DIR) + "/scenes/paper/plastic.yaml",
                                {"basis=" + basis, fmt::format("degree={}", degree)});
  const auto built = buildModel<2>(scene);
  Model<2>& model = *built;
  const auto terms = model.terms();
  Newton newton(terms, model.prescribed(), residualScales(model), {});
  Stepping stepping(
      newton, terms, [&](double t) { return model.target(t); }, {}, model.startState());
  if (stepping.advance(0.5, 0.05, [](const StepReport&) { return true; }) != Walk::Arrived)
    state.SkipWithError("the press failed");

  const NewtonTimings before = newton.timings();
  const double t = 0.55;
  for (auto _ : state) {
    Eigen::VectorXd x = stepping.state().x + stepping.state().lastIncrement;
    benchmark::DoNotOptimize(newton.solve(t, model.target(t), x));
  }
  const NewtonTimings& after = newton.timings();
  const auto iterations = static_cast<double>(after.iterations - before.iterations);
  const auto perIteration = [&](double seconds) { return 1e3 * seconds / iterations; };
  const double assembly = perIteration(after.terms[0] - before.terms[0]);
  const double contact = perIteration(after.terms[1] - before.terms[1]);
  const double factorisation = perIteration(after.factorisation - before.factorisation);
  const double solve = perIteration(after.solve - before.solve);
  state.counters["ms_iteration"] = assembly + contact + factorisation + solve;
  state.counters["ms_assembly"] = assembly;
  state.counters["ms_contact"] = contact;
  state.counters["ms_factor"] = factorisation;
  state.counters["ms_solve"] = solve;
  state.counters["iterations"] = iterations / static_cast<double>(state.iterations());
  state.counters["unknowns"] = static_cast<double>(newton.system().freeUnknowns().size());
  state.counters["factor_nonzeros"] = static_cast<double>(newton.linearSolver().factorNonZeros());
}

void nurbs(benchmark::State& s) {
  newtonIteration(s, "nurbs", static_cast<int>(s.range(0)));
}
void lagrange(benchmark::State& s) {
  newtonIteration(s, "lagrange", static_cast<int>(s.range(0)));
}

BENCHMARK(nurbs)->DenseRange(2, 4)->Unit(benchmark::kMillisecond);
BENCHMARK(lagrange)->DenseRange(2, 4)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace burnish
