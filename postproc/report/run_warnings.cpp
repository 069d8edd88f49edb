#include "postproc/report/run_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

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

/// Infinite without contact.
double largestSoundPenetration(const ResultReader& result) {
  const ModelRecord& model = result.model();
  double limit = HUGE_VAL;
  if (result.numFrames() == 0) return limit;
  const FrameRecord first = result.frame(0);
  const MeshRecord& mesh = meshOf(model, first);
  for (const ContactRecord& contact : first.contact)
    limit = std::min(limit, kDoubtfulSpanShare * (model.dim == 2 ? smallestSpan<2>(mesh, contact)
                                                                 : smallestSpan<3>(mesh, contact)));
  for (const ToolRecord& tool : model.tools)
    limit = std::min(limit, kDoubtfulRadiusShare * tool.halfThickness);
  return limit;
}

/// share: of the steps. detail: may be empty.
std::string sentenceOf(const std::string& what, double firstTime, double share, const std::string& detail) {
  return fmt::format("{}: first at t = {}, in {:.1f} % of the steps{}{}.", what, numberText(firstTime, 5),
                     100.0 * std::min(1.0, share), detail.empty() ? "" : "; ", detail);
}

/// Since when and how often a column is doubtful; empty if never.
std::string doubt(const HistoryTable& history, const std::string& column, const std::string& what,
                  const std::function<bool(double)>& isDoubtful) {
  const auto* values = findColumn(history, column);
  const auto* times = findColumn(history, "time");
  if (values == nullptr || times == nullptr) return {};
  const auto first = std::find_if(values->begin(), values->end(), isDoubtful);
  if (first == values->end()) return {};
  const auto count = std::count_if(first, values->end(), isDoubtful);
  const auto steps = std::max<std::ptrdiff_t>(1, std::ssize(*values) - 1);  // the first row is the start
  return sentenceOf(what, (*times)[static_cast<std::size_t>(first - values->begin())],
                    static_cast<double>(count) / static_cast<double>(steps), "");
}

std::string penetrationDoubt(const RunRecord& run) {
  const double limit = largestSoundPenetration(run.result);
  if (!std::isfinite(limit)) return {};
  return doubt(run.history, "max_penetration",
               fmt::format("Point-wise penetration above {}, a tenth of the smallest knot span of a contact "
                           "face or 1 % of a tool's radius",
                           plainNumber(limit)),
               [limit](double value) { return value > limit; });
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
  return texts;
}

/// What the history of a run without an end shows.
std::vector<std::string> doubtsOfHistory(const RunRecord& run) {
  return {penetrationDoubt(run),
          doubt(run.history, "min_detJ", fmt::format("Volume ratio J below {}", kDoubtfulJ),
                [](double value) { return value < kDoubtfulJ; })};
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
