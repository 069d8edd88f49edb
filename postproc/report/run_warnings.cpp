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
#include "postproc/text/account_text.h"
#include "postproc/text/markdown.h"

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
    limit =
        std::min(limit, limitOf(Condition::Penetration) * (model.dim == 2 ? smallestSpan<2>(mesh, contact)
                                                                          : smallestSpan<3>(mesh, contact)));
  }
  for (const ToolRecord& tool : model.tools)
    limits.ofTools = std::min(limits.ofTools, kDoubtfulRadiusShare * tool.halfThickness);
  return limits;
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
  // The first row is the start.
  return doubtText(what, (*times)[first], static_cast<double>(count), static_cast<int>(times->size()) - 1) +
         ".";
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
  return doubt(
      run.history,
      fmt::format("Point-wise penetration above {} of the smallest knot span of a contact face or {} of a "
                  "tool's radius",
                  shareText(limitOf(Condition::Penetration)), shareText(kDoubtfulRadiusShare)),
      [&](std::size_t row) {
        const SoundPenetration sound = limits.at(row);
        return (ofTools != nullptr && (*ofTools)[row] > sound.ofTools) ||
               (ofItself != nullptr && (*ofItself)[row] > sound.ofItself);
      });
}

std::string smallJDoubt(const RunRecord& run) {
  const auto* smallest = findColumn(run.history, "min_detJ");
  if (smallest == nullptr) return {};
  return doubt(run.history, fmt::format("Volume ratio J below {}", limitOf(Condition::SmallJ)),
               [&](std::size_t row) { return (*smallest)[row] < limitOf(Condition::SmallJ); });
}

/// With a capital letter and a full stop.
std::string asSentence(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text + ".";
}

/// What a run that has ended says itself: of its scene, whose keys are no words, and of its results.
std::vector<std::string> ownWarnings(const RunAccount& account) {
  std::vector<std::string> texts;
  for (const std::string& warning : account.warnings) texts.push_back(warning + ".");
  for (const std::string& warning : warningsOf(account)) texts.push_back(asSentence(warning));
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
  if (!run.account)
    return fmt::format("The run has not ended: it goes on, or was killed. Its last step is{}.",
                       last.empty() ? " not known" : last);
  if (run.account->completed) return {};
  return fmt::format("The run stopped{} before its end: {}.", last, run.account->stoppedBecause);
}

std::string openGap(const RunAccount& account) {
  if (account.worstConstraint <= account.constraintTolerance) return {};
  return fmt::format("The largest averaged gap of {} is above the tolerance of {}.",
                     plainNumber(account.worstConstraint), plainNumber(account.constraintTolerance));
}

std::string roundOff(const RunAccount& account) {
  if (account.stepsAtRoundOff == 0) return {};
  return fmt::format(
      "{} {} ended above the tolerance, at {} or less, where the rounding of the forces allows no less; this "
      "is harmless.",
      account.stepsAtRoundOff, account.stepsAtRoundOff == 1 ? "step" : "steps",
      plainNumber(account.worstResidual));
}

}  // namespace

std::vector<std::string> runWarnings(const RunRecord& run) {
  std::vector<std::string> texts{incompleteness(run)};
  if (run.account) {
    texts.push_back(roundOff(*run.account));
    texts.push_back(openGap(*run.account));
  }
  std::ranges::move(run.account ? ownWarnings(*run.account) : doubtsOfHistory(run),
                    std::back_inserter(texts));
  std::erase(texts, "");
  return texts;
}

}  // namespace burnish
