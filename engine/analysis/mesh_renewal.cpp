#include "engine/analysis/mesh_renewal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "engine/analysis/archive_body.h"
#include "engine/core/error.h"

namespace burnish::inline analysis {
namespace {

/// On a new mesh the step begins at a quarter of the nominal one.
constexpr int kFirstLevel = 2;

/// Parts in which the gaps with which a simulation begins are taken away, until one of them leads to
/// equilibrium.
constexpr std::array kParts{1, 4, 16};

}  // namespace

void copyHistory(Term& from, Term& to) {
  StateArchive saved;
  from.archive(saved);
  StateArchive restored(saved.values());
  to.archive(restored);
}

template <int Dim>
SteppingState continuedSteps(const Simulation<Dim>& before, const Model<Dim>& next) {
  const Model<Dim>& model = *before.model;
  SteppingState start = before.stepping.state();
  toolUnknowns(next, start.x = next.startState().x) = toolUnknowns(model, before.stepping.state().x);
  for (std::size_t k = 0; k < next.toolLoads().size(); ++k)
    copyHistory(*model.toolLoads()[k].term, *next.toolLoads()[k].term);
  start.level = std::max(start.level, kFirstLevel);
  start.easySteps = 0;
  start.lastIncrement.resize(0);
  return start;
}

template <int Dim>
MeshRenewal<Dim>::MeshRenewal(const Scene& scene, std::size_t body, const Simulation<Dim>& initial,
                              const Team& team)
    : scene_(scene), number_(body), team_(team), volume_(bodyOf(initial).bulk->stressFreeVolume()) {}

template <int Dim>
typename MeshRenewal<Dim>::Next MeshRenewal<Dim>::tried(Simulation<Dim>& simulation,
                                                        const std::function<Next()>& attempt) {
  // Evaluated with the partners of faces as they are now, as a resumed run does.
  if (!simulation.evaluateHere().admissible) {
    fail(simulation, "its state cannot be evaluated again");
    return nullptr;
  }
  try {
    return attempt();
  } catch (const Error& error) {
    fail(simulation, error.what());
    return nullptr;
  }
}

template <int Dim>
typename MeshRenewal<Dim>::Next MeshRenewal<Dim>::continuedOn(
    const Simulation<Dim>& before, RezonedBody<Dim> body,
    const std::function<SteppingState(const Model<Dim>&)>& startOf, const MeshTraits& mesh) {
  Settled next = settledOn(body, startOf);
  lastReport_ = next.settlement.report;
  if (lastReport_.outcome != NewtonOutcome::Converged) {
    fail(before, fmt::format("no equilibrium on a new mesh of quality {:.2g}, {}", mesh.quality,
                             describe(lastReport_.outcome)));
    return nullptr;
  }
  next.simulation->recorder.continueFrom(before.recorder);
  next.simulation->record();
  body_ = std::move(body);
  records_.push_back(recordOf(before, next, mesh));
  next.simulation->recorder.noteRezoning(records_.back());
  return std::move(next.simulation);
}

template <int Dim>
typename MeshRenewal<Dim>::Settled MeshRenewal<Dim>::settledOn(
    const RezonedBody<Dim>& body, const std::function<SteppingState(const Model<Dim>&)>& startOf) const {
  Settled next;
  long failedIterations = 0;
  for (const int parts : kParts) {
    auto model = rebuildModel(scene_, body);
    SteppingState start = startOf(*model);
    start.iterations += failedIterations;
    model->releaseBehind(start.time, start.x);
    next.simulation = std::make_unique<Simulation<Dim>>(scene_, std::move(model), std::move(start), team_);
    next.settlement = settle(*next.simulation, bodyOf(*next.simulation), parts);
    if (next.settlement.report.outcome == NewtonOutcome::Converged) break;
    failedIterations += next.settlement.report.iterations;
  }
  return next;
}

template <int Dim>
RezoningRecord MeshRenewal<Dim>::recordOf(const Simulation<Dim>& before, const Settled& after,
                                          const MeshTraits& mesh) const {
  const Simulation<Dim>& now = *after.simulation;
  return {.time = before.stepping.state().time,
          .energyLost = before.recorder.current().strainEnergy - now.recorder.current().strainEnergy,
          .gapWork = after.settlement.gapWork,
          .volumeDrift = bodyOf(now).bulk->stressFreeVolume() / volume_ - 1.0,
          .boundaryError = mesh.boundaryError,
          .quality = mesh.quality,
          .smallestSpan = mesh.smallestSpan,
          .iterations = after.settlement.report.iterations};
}

template <int Dim>
void MeshRenewal<Dim>::fail(const Simulation<Dim>& simulation, const std::string& why) {
  ++numFailures_;
  lastFailure_ = fmt::format("t = {:.6g}: {}", simulation.stepping.state().time, why);
}

template <int Dim>
void MeshRenewal<Dim>::archive(StateArchive& archive) {
  archive.field("failures", numFailures_);
  archiveRecords(archive);
  if (!records_.empty()) archiveBody(archive, scene_.allBodies()[number_].material, body_);
}

template <int Dim>
void MeshRenewal<Dim>::archiveRecords(StateArchive& archive) {
  constexpr Eigen::Index perRecord = 8;
  Eigen::MatrixXd values(perRecord, std::ssize(records_));
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    const auto& r = records_[static_cast<std::size_t>(k)];
    values.col(k) << r.time, r.energyLost, r.gapWork, r.volumeDrift, r.boundaryError, r.quality,
        r.smallestSpan, r.iterations;
  }
  archiveMatrix(archive, "records", perRecord, values);
  records_.clear();
  for (const auto& r : values.colwise())
    records_.push_back({r(0), r(1), r(2), r(3), r(4), r(5), r(6), static_cast<int>(r(7))});
}

template <int Dim>
typename MeshRenewal<Dim>::Next MeshRenewal<Dim>::restoredSimulation() const {
  if (!body_) return nullptr;
  auto model = rebuildModel(scene_, *body_);
  SteppingState start = model->startState();
  return std::make_unique<Simulation<Dim>>(scene_, std::move(model), std::move(start), team_);
}

template SteppingState continuedSteps(const Simulation<2>&, const Model<2>&);
template SteppingState continuedSteps(const Simulation<3>&, const Model<3>&);
template class MeshRenewal<2>;
template class MeshRenewal<3>;

}  // namespace burnish::inline analysis
