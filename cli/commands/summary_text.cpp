#include "cli/commands/summary_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace burnish {
namespace {

std::string line(const std::string& label, const std::string& text) {
  return fmt::format("  {:<22}{}\n", label, text);
}

/// How far the work done on the body and what became of it are apart.
std::string balance(const RunSummary& summary) {
  double gapWork = 0.0;
  for (const auto& rezoning : summary.rezonings) gapWork += rezoning.gapWork;
  if (summary.end.externalWork + gapWork == 0.0 && imbalanceOf(summary.end, gapWork) == 0.0)
    return "nothing stored, no work done";
  return fmt::format("{} differs by {:.2g} % from energies and plastic work; doubtful above {:.0f} %",
                     summary.rezonings.empty() ? "external work" : "work, that of closing gaps included,",
                     100.0 * imbalanceOf(summary.end, gapWork), 100.0 * kDoubtfulBalance);
}

std::string rezonings(const RunSummary& summary) {
  std::string text = std::to_string(summary.rezonings.size());
  if (summary.failedRezonings > 0)
    text +=
        fmt::format("; {} attempts failed, the last at {}", summary.failedRezonings, summary.rezoningFailure);
  return text;
}

std::string outcome(const RunSummary& summary) {
  if (summary.completed) return fmt::format("completed in {:.3g} s\n", summary.timings.total);
  return fmt::format("stopped after {:.3g} s\n", summary.timings.total);
}

}  // namespace

std::string summaryText(const RunSummary& s) {
  const StateQuantities& end = s.end;
  std::string text = outcome(s);
  text += line("steps", fmt::format("{}, {} cut-backs, smallest step {:.3g}, {} frames", s.steps, s.cuts,
                                    s.smallestStep, s.frames));
  text += line("iterations", fmt::format("{}, {:.2f} per step, at most {} in one", s.iterations,
                                         s.meanIterations, s.maxIterations));
  text += line("unknowns", std::to_string(s.unknowns));
  if (!s.rezonings.empty() || s.failedRezonings > 0) text += line("rezonings", rezonings(s));
  text += line("worst residual", fmt::format("{:.2e}, tolerance {:.0e}", s.worstResidual, s.tolerance));
  if (s.stepsAtRoundOff > 0)
    text += line("rounding", fmt::format("{} steps ended above the tolerance, at {:.1e} or less, where the "
                                         "rounding of the forces allows no less; this is harmless",
                                         s.stepsAtRoundOff, s.worstResidual));
  if (s.contactParameter > 0.0)
    text += line("contact", fmt::format("parameter {:.4g}, worst averaged gap {:.2e}, tolerance {:.0e}",
                                        s.contactParameter, s.worstConstraint, s.constraintTolerance));
  text += line("energies at the end", fmt::format("strain {:.8g}, contact {:.4g}, plastic work {:.8g}",
                                                  end.strainEnergy, end.contactEnergy, end.plasticWork));
  text += line("external work", fmt::format("{:.8g}", end.externalWork));
  text += line("balance", balance(s));
  if (s.stabilised)
    text += line(
        "stabilisation",
        fmt::format(
            "carries {:.2g} % of the largest force at the end, {:.2g} % at most; took {:.4g} of the work",
            100.0 * end.stabilisedShare, 100.0 * s.largestStabilisedShare, end.stabilisationWork));
  if (end.maxPlasticStrain > 0.0)
    text += line(
        "plastic strain",
        fmt::format("at most {:.5g} at quadrature points; projected {:.5g} to {:.5g}", end.maxPlasticStrain,
                    std::max(0.0, end.projectedPlasticStrain.min), end.projectedPlasticStrain.max));
  for (const ReactionRecord& reaction : s.reactions) text += line(reaction.support, reactionText(reaction));
  text += line("smallest J", fmt::format("{:.5g} at quadrature points", s.smallestJ));
  text += line("largest penetration", fmt::format("{:.3g} at quadrature points", s.largestPenetration));
  return text;
}

std::vector<std::string> warnings(const RunSummary& summary) {
  std::vector<std::string> texts;
  for (const DoubtRecord& doubt : summary.doubts)
    texts.push_back(fmt::format("{}: first at t = {:.5g}, in {:.1f} % of the steps{}{}", doubt.what,
                                doubt.firstTime,
                                std::min(100.0, 100.0 * doubt.steps / std::max(1, summary.steps)),
                                doubt.detail.empty() ? "" : "; ", doubt.detail));
  for (const std::string& tool : summary.idleTools)
    texts.push_back(fmt::format("tool '{}' has never touched the body", tool));
  return texts;
}

std::string timingsText(const RunSummary& summary) {
  const RunTimings& t = summary.timings;
  const std::array<std::pair<const char*, double>, 6> parts{{{"assembly", t.assembly},
                                                             {"contact", t.contact},
                                                             {"factorisation", t.factorisation},
                                                             {"solve", t.solve},
                                                             {"projection", t.projection},
                                                             {"output", t.output}}};
  std::string text = "timings\n";
  double rest = t.total;
  for (const auto& [name, seconds] : parts) {
    text += line(name, fmt::format("{:8.3f} s", seconds));
    rest -= seconds;
  }
  text += line("everything else", fmt::format("{:8.3f} s", rest));
  const double perIteration = 1000.0 * (t.assembly + t.contact + t.factorisation + t.solve) /
                              static_cast<double>(std::max(1l, summary.iterations));
  text += line("a Newton iteration", fmt::format("{:.2f} ms on average", perIteration));
  return text;
}

}  // namespace burnish
