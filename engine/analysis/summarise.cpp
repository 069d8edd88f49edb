#include "engine/analysis/summarise.h"

#include <algorithm>
#include <optional>

#include "engine/core/shares.h"

namespace burnish::inline analysis {
namespace {

/// ε of the first contact pair, or else of the first face that may touch itself; 0 without.
template <int Dim>
double contactParameter(const Model<Dim>& model) {
  if (!model.contacts().empty()) return model.contacts().front().term->parameter();
  if (!model.pairs().empty()) return model.pairs().front().term->parameter();
  if (!model.selfContacts().empty()) return model.selfContacts().front().term->parameter();
  return 0.0;
}

/// Smallest values of projected fields, which oscillate about steep changes.
template <int Dim>
void noteMinima(RunSummary& summary, const Recorder<Dim>& recorder) {
  summary.vonMisesMinimum = recorder.projectedVonMises().min;
  if (summary.end.maxPlasticStrain > 0.0)
    summary.plasticStrainMinimum = summary.end.projectedPlasticStrain.min;
}

}  // namespace

void addResiduals(RunSummary& summary, const NewtonReport& report) {
  summary.worstResidual = std::max(summary.worstResidual, report.residual);
  summary.worstConstraint = std::max(summary.worstConstraint, report.constraint);
  summary.stepsAtRoundOff += report.atRoundOff ? 1 : 0;
}

template <int Dim>
void addCosts(RunSummary& summary, Simulation<Dim>& simulation) {
  const Model<Dim>& model = *simulation.model;
  const std::size_t contacts = model.contacts().size() + model.pairs().size() + model.selfContacts().size();
  const auto& timings = simulation.newton.timings();
  for (std::size_t k = 0; k < timings.terms.size(); ++k) {
    const std::size_t first = model.bodies().size();
    const bool isContact = k >= first && k < first + contacts;
    (isContact ? summary.timings.contact : summary.timings.assembly) += timings.terms[k];
  }
  summary.timings.factorisation += timings.factorisation;
  summary.timings.solve += timings.solve;
  auto& solver = simulation.newton.linearSolver();
  summary.factorNonZeros = std::max(summary.factorNonZeros, solver.factorNonZeros());
  summary.luFactorisations += solver.numIndefinite();
  if (const auto counts = solver.counts()) {
    const auto add = [](std::optional<long>& sum, long count) { sum = sum.value_or(0) + count; };
    add(summary.linearSystems, counts->systems);
    add(summary.linearIterations, counts->iterations);
    add(summary.linearSetUps, counts->setUps);
    add(summary.linearFallbacks, counts->fallbacks);
  }
}

template <int Dim>
void describeRanks(RunSummary& summary, const Simulation<Dim>& simulation, const Team& team) {
  if (team.isAlone()) return;
  int spans = 0;
  for (const auto& body : simulation.model->bodies()) {
    spans += body.bulk->numWorkedOn();
    summary.spans += static_cast<int>(body.quadrature->spans().size());
  }
  const SparseSystem& system = simulation.newton.system();
  std::vector<double> numbers{
      static_cast<double>(spans),
      static_cast<double>(system.leading().nonZeros() + system.leadingElsewhere().nonZeros()),
      team.bytesSent()};
  gatherLists(team, numbers);
  for (std::size_t k = 0; k < numbers.size(); k += 3)
    summary.ranks.push_back({static_cast<int>(numbers[k]), numbers[k + 1], numbers[k + 2]});
}

template <int Dim>
int numEquations(const Model<Dim>& model) {
  return static_cast<int>(std::ranges::count(model.prescribed(), false));
}

template <int Dim>
void describeEnd(RunSummary& summary, const Simulation<Dim>& simulation) {
  const Model<Dim>& model = *simulation.model;
  const SteppingState& state = simulation.stepping.state();
  summary.functions = model.body().numNodes;
  summary.unknowns = numEquations(model);
  summary.cuts = state.cuts;
  summary.smallestStep = state.smallestStep;
  summary.iterations = state.iterations - summary.approachIterations;
  summary.meanIterations = static_cast<double>(summary.iterations) / std::max(1, summary.steps);
  summary.tolerance = simulation.newton.options().tolerance;
  summary.constraintTolerance = simulation.newton.options().constraintTolerance;
  summary.contactParameter = contactParameter(model);

  const Recorder<Dim>& recorder = simulation.recorder;
  summary.end = recorder.current();
  summary.endTime = summary.end.time;
  if (summary.completed) noteMinima(summary, recorder);
  summary.smallestJ = recorder.smallestJ();
  summary.largestPenetration = recorder.largestPenetration();
  if (model.stabilisation() != nullptr) {
    summary.stabilisedShare = summary.end.stabilisedShare;
    summary.largestStabilisedShare = recorder.largestStabilisedShare();
    summary.stabilisationWork = summary.end.stabilisationWork;
  }
  summary.doubts = recorder.doubts();
  std::stable_sort(summary.doubts.begin(), summary.doubts.end(),
                   [](const DoubtRecord& a, const DoubtRecord& b) { return a.firstTime < b.firstTime; });
  summary.reactions = recorder.reactions().records();
  summary.idleTools = recorder.idleTools();
  summary.timings.projection = recorder.projectionSeconds();
}

template void addCosts(RunSummary&, Simulation<2>&);
template void addCosts(RunSummary&, Simulation<3>&);
template void describeRanks(RunSummary&, const Simulation<2>&, const Team&);
template void describeRanks(RunSummary&, const Simulation<3>&, const Team&);
template int numEquations(const Model<2>&);
template int numEquations(const Model<3>&);
template void describeEnd(RunSummary&, const Simulation<2>&);
template void describeEnd(RunSummary&, const Simulation<3>&);

}  // namespace burnish::inline analysis
