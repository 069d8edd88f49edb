// A block in three dimensions with as many functions in each direction, stretched: what its tangent costs to
// assemble and to factorise on one core. Times are medians of processor time in milliseconds; beside them
// what no other load on the machine changes: unknowns, spans, non-zeros and operations.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <malloc.h>
#include <tbb/global_control.h>

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/solid/bulk_term.h"

namespace burnish {
namespace {

enum class Law { NeoHookean, J2 };

struct Case {
  int degree = 2;
  int functions = 15;  ///< per direction
  Law law = Law::NeoHookean;
  Formulation formulation = Formulation::Displacement;
};

Material materialOf(Law law) {
  if (law == Law::NeoHookean) return NeoHookean({1.0, 0.3});
  return J2Plasticity({100.0, 0.3, ElasticLaw::NeoHookean, VoceHardening{0.5, 1.0, 10.0}});
}

Body<3> block(const Case& c) {
  const KnotVector knots = KnotVector::uniform(c.degree, c.functions - c.degree);
  return makeBody(refined(box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}), {knots, knots, knots}));
}

/// A stretch of one per cent, twice what makes the metal flow.
Eigen::VectorXd stretched(const Body<3>& body) {
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(3, body.numNodes);
  u.row(0) = 0.01 * body.nodePositions().row(0);
  return u.reshaped();
}

std::vector<bool> leftFaceHeld(const Body<3>& body) {
  std::vector<bool> held(static_cast<std::size_t>(3 * body.numNodes), false);
  for (const int a : faceFunctions(body.patches[0].basis(), faceFromName<3>("left")))
    for (int d = 0; d < 3; ++d) held[static_cast<std::size_t>(3 * a + d)] = true;
  return held;
}

/// Multiplications and additions of one span of degree p with displacements, without those of the law:
/// deformation gradients, forces, moduli, and the sums over one direction after the other.
double spanOperations(int degree) {
  const double m = degree + 1.0;
  return std::pow(m, 3) * (36.0 * std::pow(m, 3) + 1008.0) + 192.0 * std::pow(m, 5) + 108.0 * std::pow(m, 6) +
         48.0 * std::pow(m, 7);
}

/// What a projected volume change adds to a span: gradients of J and of the law, and its share of the
/// coupling.
double spanCouplingOperations(int degree) {
  const double n = std::pow(degree + 1.0, 3), functions = std::pow(degree, 3);
  return n * (36.0 * n + 12.0 * n * functions + 2.0 * functions * functions);
}

/// Operations of Y = Z E + C and of Y Zᵀ + Z Cᵀ. All sums are products of those over one direction: of a
/// function of Π that lives on the spans from `begin` to `end`, the nodes of these, and of the functions that
/// it overlaps.
double couplingOperations(int degree, int functions) {
  const int spans = functions - degree;
  const auto nodes = [&](int begin, int end) {
    return std::min(end, spans) - std::max(begin, 0) + static_cast<double>(degree);
  };
  double nearNear = 0.0, nearFar = 0.0, overlaps = 0.0;
  for (int A = 0; A < functions - 1; ++A) {
    const double near = nodes(A - degree + 1, A + 1);
    nearNear += near * near;
    nearFar += near * nodes(A - 2 * degree + 2, A + degree);
    overlaps += near * (std::min(A + degree, functions - 1) - std::max(A - degree + 1, 0));
  }
  return 18.0 * (std::pow(nearFar, 3) + std::pow(nearNear, 3)) + 6.0 * std::pow(overlaps, 3);
}

double assemblyOperations(const Case& c) {
  const double spans = std::pow(c.functions - c.degree, 3);
  if (c.formulation == Formulation::Displacement) return spans * spanOperations(c.degree);
  return spans * (spanOperations(c.degree) + spanCouplingOperations(c.degree)) +
         couplingOperations(c.degree, c.functions);
}

/// Highest resident memory since the last call of `forgetPeak()`, in megabytes.
double peakMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmHWM:" && status >> word) return std::stod(word) / 1024.0;
  return 0.0;
}

void forgetPeak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return 1e3 * values[values.size() / 2];
}

/// Times of the parts of a Newton iteration, in seconds, one entry for each repetition.
struct Times {
  std::vector<double> assembly, factorisation, solve;
};

/// Processor time of f, which no other load on the machine stretches.
template <class F>
void measure(std::vector<double>& times, const F& f) {
  const std::clock_t begin = std::clock();
  f();
  times.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
}

void stretchedBlock(benchmark::State& state, const Case& c) {
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  forgetPeak();
  const Body<3> body = block(c);
  const SpanQuadrature<3> quadrature(body);
  const auto term = makeBulkTerm(body, quadrature, materialOf(c.law), c.formulation);
  const Eigen::VectorXd x = stretched(body);
  std::vector<double> setup, analysis;
  std::unique_ptr<SparseSystem> system;
  measure(setup, [&] {
    system =
        std::make_unique<SparseSystem>(leftFaceHeld(body), std::vector<CouplingGroups>{term->couplings()});
  });

  Times times;
  Eigen::VectorXd force(x.size());
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>> cholesky;
  for (auto _ : state) {
    measure(times.assembly, [&] {
      system->setZero();
      force.setZero();
      Assembly out{force, system.get()};
      if (!term->evaluate(0.0, x, out)) state.SkipWithError("the state is not admissible");
    });
    const Eigen::SparseMatrix<double> K = system->whole().triangularView<Eigen::Lower>();
    if (analysis.empty()) measure(analysis, [&] { cholesky.analyzePattern(K); });
    measure(times.factorisation, [&] { cholesky.factorize(K); });
    if (cholesky.info() != Eigen::Success) state.SkipWithError("the tangent is not positive definite");
    measure(times.solve,
            [&] { benchmark::DoNotOptimize(cholesky.solve(system->restrictToFree(force)).eval()); });
  }
  const double assembly = median(times.assembly), factorisation = median(times.factorisation);
  state.counters["unknowns"] = static_cast<double>(system->freeUnknowns().size());
  state.counters["spans"] = static_cast<double>(quadrature.spans().size());
  state.counters["nonzeros"] = static_cast<double>(system->whole().nonZeros());
  state.counters["factor_nonzeros"] = cholesky.cholmod().lnz;
  state.counters["factor_gflop"] = 1e-9 * cholesky.cholmod().fl;
  state.counters["assembly_gflop"] = 1e-9 * assemblyOperations(c);
  state.counters["ms_setup"] = median(setup);
  state.counters["ms_analysis"] = median(analysis);
  state.counters["ms_assembly"] = assembly;
  state.counters["ms_factor"] = factorisation;
  state.counters["ms_solve"] = median(times.solve);
  state.counters["assembly_share"] = assembly / (assembly + factorisation);
  state.counters["peak_MB"] = peakMemory();
}

/// solid/FORMULATION/LAW/pDEGREE/FUNCTIONS
void registerCase(const Case& c) {
  const auto name =
      fmt::format("solid/{}/{}/p{}/{}", c.formulation == Formulation::Displacement ? "displacement" : "fbar",
                  c.law == Law::NeoHookean ? "neo-hookean" : "j2", c.degree, c.functions);
  benchmark::RegisterBenchmark(name.c_str(), [c](benchmark::State& state) { stretchedBlock(state, c); })
      ->Unit(benchmark::kMillisecond)
      ->Iterations(3);
}

const bool kRegistered = [] {
  for (const auto formulation : {Formulation::Displacement, Formulation::ProjectedDilatation})
    for (const auto law : {Law::NeoHookean, Law::J2})
      for (int degree = 1; degree <= 4; ++degree)
        for (const int functions : {11, 15, 19, 24}) registerCase({degree, functions, law, formulation});
  return true;
}();

}  // namespace
}  // namespace burnish
