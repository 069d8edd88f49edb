#include "postproc/report/run_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "postproc/text/markdown.h"

namespace burnish {
namespace {

/// Adds lines made of numbers of the summary; a line is left out where one is missing.
class FactList {
 public:
  explicit FactList(const RunRecord& run) : run_(run) {}

  template <class Text>
  void add(const std::string& name, std::initializer_list<const char*> entries, const Text& text) {
    std::vector<std::string> numbers;
    for (const char* entry : entries) {
      const auto value = run_.number(entry);
      if (!value) return;
      numbers.push_back(plainNumber(*value));
    }
    facts_.emplace_back(name, text(numbers));
  }

  void add(const std::string& name, const std::string& text) { facts_.emplace_back(name, text); }

  Facts take() { return std::move(facts_); }

 private:
  const RunRecord& run_;
  Facts facts_;
};

using Numbers = std::vector<std::string>;

std::string alone(const Numbers& n) {
  return n[0];
}

std::string withTolerance(const Numbers& n) {
  return fmt::format("{} (tolerance {})", n[0], n[1]);
}

/// How far the work and what became of it are apart at the end; empty if the history does not say.
std::string balance(const HistoryTable& history) {
  double found = 0.0;
  for (const char* name : {"strain_energy", "contact_energy", "plastic_work"}) {
    const auto* column = findColumn(history, name);
    if (column == nullptr || column->empty()) return {};
    found += column->back();
  }
  const auto* work = findColumn(history, "external_work");
  if (work == nullptr) return {};
  const auto* gapWork = findColumn(history, "rezoning_gap_work");
  const double done = work->back() + (gapWork != nullptr ? gapWork->back() : 0.0);
  const double scale = std::max(std::abs(found), std::abs(done));
  if (scale == 0.0) return {};
  return fmt::format("{} differs by {:.2g} % from energies and plastic work at the end",
                     gapWork != nullptr ? "work, that of closing gaps included," : "external work",
                     100.0 * std::abs(done - found) / scale);
}

/// How often the body was meshed anew; empty if it never was to be.
std::string rezonings(const RunRecord& run) {
  if (!run.summary) return {};
  const std::vector<RezoningRecord>& all = run.summary->rezonings;
  const double failed = run.number("rezonings_failed").value_or(0.0);
  if (all.empty() && failed == 0.0) return {};
  std::string text = std::to_string(all.size());
  if (!all.empty()) {
    double error = 0.0, quality = 1.0;
    for (const RezoningRecord& rezoning : all) {
      error = std::max(error, rezoning.boundaryError);
      quality = std::min(quality, rezoning.quality);
    }
    text += fmt::format(", the last at t = {:.6g}; lowest quality {:.2g}, largest error of a boundary {:.2g}",
                        all.back().time, quality, error);
  }
  if (failed > 0.0)
    text += fmt::format("; {} attempts failed, the last at {}", failed, run.summary->rezoningFailure);
  return text;
}

}  // namespace

Facts runFacts(const RunRecord& run) {
  FactList facts(run);
  facts.add("state", run.state());
  facts.add("end", {"end_time"}, [](const Numbers& n) { return "t = " + n[0]; });
  facts.add("basis functions", {"functions"}, alone);
  facts.add("unknowns", {"unknowns"}, alone);
  facts.add("frames", std::to_string(run.result.numFrames()));
  facts.add("steps", {"steps", "cut_backs", "smallest_step"}, [](const Numbers& n) {
    return fmt::format("{}, {} cut-backs, smallest step {}", n[0], n[1], n[2]);
  });
  facts.add("iterations", {"iterations", "mean_iterations", "max_iterations"}, [](const Numbers& n) {
    return fmt::format("{}, {} per step, at most {} in one", n[0], n[1], n[2]);
  });
  facts.add("largest residual", {"worst_residual", "tolerance"}, withTolerance);
  facts.add("largest averaged gap", {"worst_constraint", "constraint_tolerance"}, withTolerance);
  facts.add("contact parameter", {"contact_parameter"}, alone);
  facts.add("smallest J", {"smallest_J"}, alone);
  facts.add("largest penetration", {"largest_penetration"}, alone);
  if (run.summary)
    for (const ReactionRecord& reaction : run.summary->reactions)
      facts.add(reaction.support, reactionText(reaction));
  if (const std::string text = balance(run.history); !text.empty()) facts.add("balance", text);
  if (const std::string text = rezonings(run); !text.empty()) facts.add("rezonings", text);
  facts.add("time taken", {"seconds"}, [](const Numbers& n) { return n[0] + " s"; });
  facts.add("computed by", run.result.model().program);
  return facts.take();
}

}  // namespace burnish
