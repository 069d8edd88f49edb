#include "postproc/text/account_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "engine/results/doubts.h"

namespace burnish {
namespace {

constexpr double kRounding = 1e-9;         // of the largest force
constexpr double kEnergyRounding = 1e-15;  // of the largest energy

/// The last row of a history.
class LastRow {
 public:
  explicit LastRow(const HistoryTable& history) : history_(history) {}

  bool has(const std::string& column) const { return values(column) != nullptr; }

  /// 0 where the history has no such column, or no row.
  double operator()(const std::string& column) const {
    const auto* found = values(column);
    return found == nullptr ? 0.0 : found->back();
  }

 private:
  const std::vector<double>* values(const std::string& column) const {
    const std::vector<double>* found = findColumn(history_, column);
    return found == nullptr || found->empty() ? nullptr : found;
  }

  const HistoryTable& history_;
};

/// The largest energy that the body and its contact held together with what plastic flow and friction took, of
/// all rows.
double largestEnergy(const HistoryTable& history) {
  double largest = 0.0;
  for (std::size_t row = 0; row < history.numRows(); ++row) {
    double sum = 0.0;
    for (const char* name : {"strain_energy", "contact_energy", "plastic_work", "friction_work"})
      if (const auto* column = findColumn(history, name)) sum += (*column)[row];
    largest = std::max(largest, std::abs(sum));
  }
  return largest;
}

/// How far the work done on the body and what became of it are apart at the end.
std::string balance(const RunAccount& account, const HistoryTable& history) {
  const LastRow end(history);
  const double found = end("strain_energy") + end("contact_energy") + end("plastic_work") +
                       account.stabilisationWork.value_or(0.0) + end("friction_work");
  const double done = end("external_work") + end("rezoning_gap_work");
  const double imbalance = imbalanceOf(found, done, std::max(std::abs(found), largestEnergy(history)));
  const bool rubs = end.has("friction_work");
  if (done == 0.0 && imbalance == 0.0) return "nothing stored, no work done";
  return fmt::format("{} differs by {:.2g} % from energies{} plastic work{}; doubtful above {:.0f} %",
                     account.rezonings.empty() ? "external work" : "work, that of closing gaps included,",
                     100.0 * imbalance, rubs ? "," : " and", rubs ? " and work of friction" : "",
                     100.0 * limitOf(Condition::Balance));
}

/// What multigrid needed.
std::string linearSystems(const RunAccount& account) {
  const long systems = account.linearSystems.value_or(0), iterations = account.linearIterations.value_or(0),
             setUps = account.linearSetUps.value_or(0), fallbacks = account.linearFallbacks.value_or(0);
  std::string text =
      fmt::format("{} by multigrid, {:.1f} iterations in each, set up {} times", systems,
                  static_cast<double>(iterations) / static_cast<double>(std::max(1L, systems)), setUps);
  if (fallbacks > 0) text += fmt::format("; {} of them by factors in the end", fallbacks);
  return text;
}

/// How often the body was meshed anew.
std::string rezonings(const RunAccount& account) {
  const std::vector<RezoningRecord>& all = account.rezonings;
  std::string text = std::to_string(all.size());
  if (!account.rezonedBody.empty()) text += fmt::format(" of body {}", account.rezonedBody);
  if (!all.empty()) {
    double error = 0.0, quality = 1.0;
    for (const RezoningRecord& rezoning : all) {
      error = std::max(error, rezoning.boundaryError);
      quality = std::min(quality, rezoning.quality);
    }
    text += fmt::format(", the last at t = {:.6g}; lowest quality {:.2g}, largest error of a boundary {:.2g}",
                        all.back().time, quality, error);
  }
  if (account.failedRezonings > 0)
    text +=
        fmt::format("; {} attempts failed, the last at {}", account.failedRezonings, account.rezoningFailure);
  return text;
}

/// What the end of the history shows of energies, work and plastic strain.
void addEnd(AccountLines& lines, const RunAccount& account, const HistoryTable& history) {
  const LastRow end(history);
  if (end.has("strain_energy") && end.has("external_work")) {
    const double least = kEnergyRounding * largestEnergy(history);
    const auto energy = [&](const char* name) { return std::abs(end(name)) > least ? end(name) : 0.0; };
    lines.emplace_back(
        "energies at the end",
        fmt::format("strain {:.8g}, contact {:.4g}, plastic work {:.8g}", energy("strain_energy"),
                    energy("contact_energy"), energy("plastic_work")));
    lines.emplace_back("external work", fmt::format("{:.8g}", end("external_work")));
    lines.emplace_back("balance", balance(account, history));
  }
  if (account.stabilisedShare)
    lines.emplace_back(
        "stabilisation",
        fmt::format(
            "carries {:.2g} % of the largest force at the end, {:.2g} % at most; took {:.4g} of the work",
            100.0 * *account.stabilisedShare, 100.0 * account.largestStabilisedShare.value_or(0.0),
            account.stabilisationWork.value_or(0.0)));
  if (end("max_plastic_strain") > 0.0)
    lines.emplace_back(
        "plastic strain",
        fmt::format("at most {:.5g} at quadrature points; projected {:.5g} to {:.5g}",
                    end("max_plastic_strain"), std::max(0.0, end("min_plastic_strain_projected")),
                    end("max_plastic_strain_projected")));
}

}  // namespace

AccountLines accountLines(const RunAccount& a, const HistoryTable& history) {
  AccountLines lines;
  const auto add = [&lines](const char* name, std::string text) {
    lines.emplace_back(name, std::move(text));
  };
  add("steps", fmt::format("{}, {} cut-backs, smallest step {:.3g}", a.steps, a.cuts, a.smallestStep));
  add("iterations",
      fmt::format("{}, {:.2f} per step, at most {} in one", a.iterations, a.meanIterations, a.maxIterations));
  add("unknowns", std::to_string(a.unknowns));
  if (a.linearIterations) add("linear systems", linearSystems(a));
  if (!a.rezonings.empty() || a.failedRezonings > 0) add("rezonings", rezonings(a));
  add("worst residual", fmt::format("{:.2e}, tolerance {:.0e}", a.worstResidual, a.tolerance));
  if (a.stepsAtRoundOff > 0)
    add("rounding",
        fmt::format("{} steps ended above the tolerance, at {:.1e} or less, where the rounding of "
                    "the forces allows no less; this is harmless",
                    a.stepsAtRoundOff, a.worstResidual));
  if (a.contactParameter > 0.0)
    add("contact", fmt::format("parameter {:.4g}, worst averaged gap {:.2e}, tolerance {:.0e}",
                               a.contactParameter, a.worstConstraint, a.constraintTolerance));
  if (a.initialStressChange)
    add("initial stress", fmt::format("changed by {:.2g} % of its largest value to be in equilibrium",
                                      100.0 * *a.initialStressChange));
  addEnd(lines, a, history);
  for (const ReactionRecord& reaction : a.reactions)
    lines.emplace_back(reaction.support, reactionText(reaction));
  add("smallest J", fmt::format("{:.5g} at quadrature points", a.smallestJ));
  add("largest penetration", fmt::format("{:.3g} at quadrature points", a.largestPenetration));
  return lines;
}

std::vector<std::string> warningsOf(const RunAccount& account) {
  std::vector<std::string> texts;
  for (const DoubtRecord& doubt : account.doubts)
    texts.push_back(doubtText(doubt.what, doubt.firstTime, doubt.steps, account.steps) +
                    (doubt.detail.empty() ? "" : "; " + doubt.detail));
  for (const std::string& tool : account.idleTools) texts.push_back(idleToolText(tool));
  return texts;
}

std::string doubtText(const std::string& what, double firstTime, double doubtfulSteps, int steps) {
  return fmt::format("{}: first at t = {:.5g}, in {:.1f} % of the steps", what, firstTime,
                     std::min(100.0, 100.0 * doubtfulSteps / std::max(1, steps)));
}

std::string idleToolText(const std::string& tool) {
  return fmt::format("tool '{}' has never touched the body", tool);
}

std::string reactionText(const ReactionRecord& reaction) {
  std::vector<std::string> components;
  for (const double f : reaction.force)
    components.push_back(fmt::format("{:.5g}", std::abs(f) > kRounding * reaction.largest ? f : 0.0));
  return fmt::format("force of the body on face {}: ({}), largest {:.5g} at t = {:.5g}", reaction.place,
                     fmt::join(components, ", "), reaction.largest, reaction.largestTime);
}

std::vector<std::pair<std::string, double>> timingsTable(const RunAccount& account) {
  const RunTimings& t = account.timings;
  std::vector<std::pair<std::string, double>> rows{{"assembly", t.assembly},           {"contact", t.contact},
                                                   {"factorisation", t.factorisation}, {"solve", t.solve},
                                                   {"projection", t.projection},       {"output", t.output}};
  double rest = t.total;
  for (const auto& [name, seconds] : rows) rest -= seconds;
  rows.emplace_back("everything else", rest);
  return rows;
}

}  // namespace burnish
