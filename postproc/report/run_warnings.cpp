#include "postproc/report/run_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>

#include "engine/results/doubts.h"
#include "engine/solid/face_quadrature.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/text/markdown.h"
#include "postproc/text/ticks.h"

namespace burnish {
namespace {

template <int Dim>
double smallestSpan(const MeshRecord& mesh, const ContactRecord& contact) {
  const auto body = makeBody(patchGeometry<Dim>(mesh.patches.at(static_cast<std::size_t>(contact.patch))));
  const FaceQuadrature<Dim> face(body, 0, faceFromName<Dim>(contact.face), 0);
  double smallest = HUGE_VAL;
  for (const auto& span : face.spans()) smallest = std::min(smallest, span.size);
  return smallest;
}

/// The largest penetrations that are not doubtful on a mesh; infinite without contact.
struct SoundPenetration {
  double ofTools = HUGE_VAL;
  double ofItself = HUGE_VAL;
};

SoundPenetration soundPenetration(const ModelRecord& model, const FrameRecord& frame) {
  SoundPenetration limits;
  const MeshRecord& mesh = meshOf(model, frame);
  for (const ContactRecord& contact : frame.contact) {
    double& limit = contact.tool.empty() ? limits.ofItself : limits.ofTools;
    limit = std::min(limit, kDoubtfulSpanShare * (model.dim == 2 ? smallestSpan<2>(mesh, contact)
                                                                 : smallestSpan<3>(mesh, contact)));
  }
  for (const ToolRecord& tool : model.tools)
    limits.ofTools = std::min(limits.ofTools, kDoubtfulRadiusShare * tool.halfThickness);
  return limits;
}

/// share: of the steps. detail: may be empty.
std::string sentenceOf(const std::string& what, double firstTime, double share, const std::string& detail) {
  return fmt::format("{}: first at t = {}, in {:.1f} % of the steps{}{}.", what, numberText(firstTime, 5),
                     100.0 * std::min(1.0, share), detail.empty() ? "" : "; ", detail);
}

/// Since when and how often rows of a history are doubtful; empty if never.
std::string doubt(const HistoryTable& history, const std::string& what,
                  const std::function<bool(std::size_t)>& isDoubtful) {
  const auto* times = findColumn(history, "time");
  if (times == nullptr) return {};
  std::size_t first = times->size(), count = 0;
  for (std::size_t row = 0; row < times->size(); ++row) {
    if (!isDoubtful(row)) continue;
    first = std::min(first, row);
    ++count;
  }
  if (count == 0) return {};
  const std::size_t steps = std::max<std::size_t>(1, times->size() - 1);  // the first row is the start
  return sentenceOf(what, (*times)[first], static_cast<double>(count) / static_cast<double>(steps), "");
}

/// The meshes of a run, by the number of rezonings before them, with what is sound on each. A mesh that no
/// frame shows is taken for the one before.
class MeshLimits {
 public:
  explicit MeshLimits(const RunRecord& run) : rezonings_(findColumn(run.history, "rezonings")) {
    const auto* rowTimes = findColumn(run.history, "time");
    if (rowTimes == nullptr) return;
    const std::vector<double> times = run.result.times();
    for (std::size_t k = 0; k < times.size(); ++k) {
      const auto row = std::find(rowTimes->begin(), rowTimes->end(), times[k]);
      if (row == rowTimes->end()) continue;
      const double count = countAt(static_cast<std::size_t>(row - rowTimes->begin()));
      if (!limits_.contains(count))
        limits_[count] = soundPenetration(run.result.model(), run.result.frame(static_cast<int>(k)));
    }
  }

  /// What is sound in a row of the history.
  SoundPenetration at(std::size_t row) const {
    const auto next = limits_.upper_bound(countAt(row));
    return next == limits_.begin() ? SoundPenetration{} : std::prev(next)->second;
  }

 private:
  double countAt(std::size_t row) const { return rezonings_ == nullptr ? 0.0 : (*rezonings_)[row]; }

  const std::vector<double>* rezonings_;
  std::map<double, SoundPenetration> limits_;
};

std::string penetrationDoubt(const RunRecord& run) {
  const auto* ofTools = findColumn(run.history, "max_penetration");
  const auto* ofItself = findColumn(run.history, "max_self_penetration");
  const MeshLimits limits(run);
  return doubt(run.history,
               "Point-wise penetration above a tenth of the smallest knot span of a contact face or 1 % of a "
               "tool's radius",
               [&](std::size_t row) {
                 const SoundPenetration sound = limits.at(row);
                 return (ofTools != nullptr && (*ofTools)[row] > sound.ofTools) ||
                        (ofItself != nullptr && (*ofItself)[row] > sound.ofItself);
               });
}

std::string smallJDoubt(const RunRecord& run) {
  const auto* smallest = findColumn(run.history, "min_detJ");
  if (smallest == nullptr) return {};
  return doubt(run.history, fmt::format("Volume ratio J below {}", kDoubtfulJ),
               [&](std::size_t row) { return (*smallest)[row] < kDoubtfulJ; });
}

/// What a run that has ended says itself: of its scene, and of its results.
std::vector<std::string> ownWarnings(const RunRecord& run) {
  std::vector<std::string> texts;
  for (const std::string& warning : run.summary->warnings) texts.push_back(warning + ".");
  const double steps = std::max(1.0, run.number("steps").value_or(0.0));
  for (const DoubtRecord& doubt : run.summary->doubts) {
    std::string what = doubt.what;
    if (!what.empty() && what.front() >= 'a' && what.front() <= 'z')
      what.front() = static_cast<char>(what.front() - 'a' + 'A');
    texts.push_back(sentenceOf(what, doubt.firstTime, doubt.steps / steps, doubt.detail));
  }
  for (const std::string& tool : run.summary->idleTools)
    texts.push_back(fmt::format("Tool '{}' has never touched the body.", tool));
  return texts;
}

/// What the history of a run without an end shows.
std::vector<std::string> doubtsOfHistory(const RunRecord& run) {
  return {penetrationDoubt(run), smallJDoubt(run)};
}

std::string incompleteness(const RunRecord& run) {
  const auto* times = findColumn(run.history, "time");
  const std::string last =
      times != nullptr && !times->empty() ? fmt::format(" at t = {}", plainNumber(times->back())) : "";
  if (!run.summary)
    return fmt::format("The run has not ended: it goes on, or was killed. Its last step is{}.",
                       last.empty() ? " not known" : last);
  if (run.summary->completed) return {};
  return fmt::format("The run stopped{} before its end: {}.", last, run.summary->stoppedBecause);
}

/// "WHAT of NUMBER is above the tolerance of NUMBER"; empty if it is not.
std::string excess(const RunRecord& run, const std::string& entry, const std::string& tolerance,
                   const std::string& what) {
  const auto value = run.number(entry), limit = run.number(tolerance);
  if (!value || !limit || *value <= *limit) return {};
  return fmt::format("{} of {} is above the tolerance of {}.", what, plainNumber(*value),
                     plainNumber(*limit));
}

std::string roundOff(const RunRecord& run) {
  const double steps = run.number("steps_at_round_off").value_or(0.0);
  if (steps == 0.0) return {};
  return fmt::format(
      "{} {} ended above the tolerance, at {} or less, where the rounding of the forces allows no less; this "
      "is harmless.",
      steps, steps == 1.0 ? "step" : "steps", plainNumber(run.number("worst_residual").value_or(0.0)));
}

}  // namespace

std::vector<std::string> runWarnings(const RunRecord& run) {
  std::vector<std::string> texts{
      incompleteness(run), roundOff(run),
      excess(run, "worst_constraint", "constraint_tolerance", "The largest averaged gap")};
  std::ranges::move(run.summary ? ownWarnings(run) : doubtsOfHistory(run), std::back_inserter(texts));
  std::erase(texts, "");
  return texts;
}

}  // namespace burnish
