#include "engine/analysis/rezoner.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "engine/analysis/archive_body.h"
#include "engine/analysis/build_model.h"
#include "engine/analysis/deformed_patch.h"
#include "engine/analysis/frames.h"
#include "engine/core/error.h"

namespace burnish {
namespace {

/// Parts in which the gaps with which a simulation begins are taken away, until one of them leads to
/// equilibrium.
constexpr std::array kParts{1, 4, 16};

/// Reference positions of the body's own nodes, 2 x nodes.
Eigen::MatrixXd ownPositions(const Body<2>& body) {
  const auto [first, end] = body.nodeRange();
  return body.nodePositions().middleCols(first, end - first);
}

}  // namespace

Rezoner::Rezoner(const Scene& scene, const Simulation<2>& initial)
    : scene_(scene),
      choice_(meshChoice(scene, initial)),
      trigger_(choice_.options, choice_.body, choice_.travel, initial),
      volume_(bodyOf(initial).bulk->weights().sum()),
      origin_(ownPositions(bodyOf(initial).body)) {}

std::unique_ptr<Simulation<2>> Rezoner::rezone(Simulation<2>& simulation) {
  // Evaluated with the partners of faces as they are now, as a resumed run does.
  const bool isAdmissible = simulation.evaluateHere().admissible;
  if (!isAdmissible) fail(simulation, "its state cannot be evaluated again");
  std::unique_ptr<Simulation<2>> next;
  try {
    if (isAdmissible) next = attempt(simulation);
  } catch (const Error& error) {
    fail(simulation, error.what());
  }
  trigger_.noteAttempt(simulation, next != nullptr);
  return next;
}

std::unique_ptr<Simulation<2>> Rezoner::attempt(Simulation<2>& simulation) {
  const Patch<2> deformed = deformedPatch(bodyOf(simulation).body, simulation.stepping.state().x);
  const auto mesh = chooseMesh(choice_, simulation, deformed, trigger_.lastPlaces());
  if (!mesh) {
    fail(simulation, "no mesh of the deformed body is sound");
    return nullptr;
  }
  const CarryOver carried(simulation, choice_.body, deformed, *mesh,
                          scene_.allBodies()[choice_.body].quadraturePoints.value_or(0));
  Settled next = settledOn(carried);
  lastReport_ = next.settlement.report;
  if (lastReport_.outcome != NewtonOutcome::Converged) {
    fail(simulation, fmt::format("no equilibrium on a new mesh of quality {:.2g}, {}", mesh->quality,
                                 describe(lastReport_.outcome)));
    return nullptr;
  }
  next.simulation->recorder.continueFrom(simulation.recorder);
  next.simulation->record();
  const auto [first, end] = bodyOf(*next.simulation).body.nodeRange();
  origin_ = next.simulation->projections[choice_.body]
                .project(carried.atQuadraturePoints(origin_))
                .transpose()
                .middleCols(first, end - first);
  body_ = carried.body();
  records_.push_back(recordOf(simulation, next, *mesh));
  next.simulation->recorder.noteRezoning(records_.back());
  return std::move(next.simulation);
}

Rezoner::Settled Rezoner::settledOn(const CarryOver& carried) const {
  Settled next;
  long failedIterations = 0;
  for (const int parts : kParts) {
    auto model = rebuildModel(scene_, carried.body());
    SteppingState start = carried.startOf(*model);
    start.iterations += failedIterations;
    next.simulation = std::make_unique<Simulation<2>>(scene_, std::move(model), std::move(start));
    next.settlement = settle(*next.simulation, bodyOf(*next.simulation), parts);
    if (next.settlement.report.outcome == NewtonOutcome::Converged) break;
    failedIterations += next.settlement.report.iterations;
  }
  return next;
}

RezoningRecord Rezoner::recordOf(const Simulation<2>& before, const Settled& after,
                                 const Remeshing& mesh) const {
  const Simulation<2>& now = *after.simulation;
  return {.time = before.stepping.state().time,
          .energyLost = before.recorder.current().strainEnergy - now.recorder.current().strainEnergy,
          .gapWork = after.settlement.gapWork,
          .volumeDrift = bodyOf(now).bulk->weights().sum() / volume_ - 1.0,
          .boundaryError = mesh.boundaryError,
          .quality = mesh.quality,
          .smallestSpan = mesh.smallestSpan,
          .iterations = after.settlement.report.iterations};
}

void Rezoner::fail(const Simulation<2>& simulation, const std::string& why) {
  ++numFailures_;
  lastFailure_ = fmt::format("t = {:.6g}: {}", simulation.stepping.state().time, why);
}

std::optional<MeshRecord> Rezoner::frameMesh(const Simulation<2>& simulation,
                                             Eigen::MatrixXd& displacement) const {
  if (records_.empty()) return std::nullopt;
  const ModelBody<2>& body = bodyOf(simulation);
  const auto [first, end] = body.body.nodeRange();
  displacement.middleCols(first, end - first) += ownPositions(body.body) - origin_;
  MeshRecord mesh = meshRecord(*simulation.model);
  mesh.patches[static_cast<std::size_t>(body.firstPatch)].points = origin_;
  return mesh;
}

void Rezoner::archive(StateArchive& archive) {
  archive.part("trigger", trigger_);
  archive.field("failures", numFailures_);
  archiveRecords(archive);
  if (records_.empty()) return;
  archiveMatrix(archive, "origin", 2, origin_);
  archiveBody(archive, scene_.allBodies()[choice_.body].material, body_);
}

void Rezoner::archiveRecords(StateArchive& archive) {
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

std::unique_ptr<Simulation<2>> Rezoner::restoredSimulation() const {
  if (!body_) return nullptr;
  auto model = rebuildModel(scene_, *body_);
  SteppingState start = model->startState();
  return std::make_unique<Simulation<2>>(scene_, std::move(model), std::move(start));
}

}  // namespace burnish
