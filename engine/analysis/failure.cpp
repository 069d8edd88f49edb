#include "engine/analysis/failure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <vector>

namespace burnish {
namespace {

/// Below it elements are so distorted that their shape is the likely reason.
constexpr double kDistortedJ = 0.1;

constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

/// Where an unknown that is a displacement stands.
template <int Dim>
std::string placeOf(const Model<Dim>& model, int unknown) {
  if (unknown < model.numDisplacements()) {
    const Eigen::Vector<double, Dim> X = model.body().nodePositions().col(unknown / Dim);
    return fmt::format("the control point at X = ({:.4g}), in {}", fmt::join(X, ", "),
                       kAxes[static_cast<std::size_t>(unknown % Dim)]);
  }
  for (const auto& tool : model.tools())
    for (std::size_t way = 0; way < kToolWays; ++way)
      if (tool->unknowns[way] == unknown)
        return fmt::format("tool '{}', {}", tool->name, way == kTurn ? "in its turn" : kAxes[way]);
  return "a constraint";
}

}  // namespace

template <int Dim>
Failure diagnose(const Model<Dim>& model, const NewtonReport& report) {
  std::vector<std::string> findings;
  if (report.worstUnknown >= 0)
    findings.push_back(fmt::format("the residual is largest at {}", placeOf(model, report.worstUnknown)));
  int changes = 0;
  for (const auto& pair : model.contacts()) {
    const ContactState& contact = pair.term->state();
    if (contact.active.empty()) continue;
    changes += contact.changes;
    findings.push_back(
        fmt::format("{} control points of face '{}' touch tool '{}', {} changed in the last iteration",
                    contact.numActive(), pair.faceName, model.tools()[pair.tool]->name, contact.changes));
  }
  for (const auto& contact : model.selfContacts()) {
    const SelfContactState& state = contact.term->state();
    changes += state.changes;
    if (state.numActive() > 0 || state.changes > 0)
      findings.push_back(fmt::format(
          "{} control points of face '{}' touch the face itself, {} changed in the last iteration",
          state.numActive(), faceName(contact.face), state.changes));
  }
  const double minJ = model.bulk().summary().minJ;
  findings.push_back(fmt::format("the smallest J is {:.3g}", minJ));

  std::string advice;
  if (minJ < kDistortedJ)
    advice =
        "the mesh is close to folding: give it more knot spans where the body is squeezed, or finer steps";
  else if (changes > 0)
    advice =
        "contact finds no rest: take more steps, a larger solver.max_cuts, more knot spans along the contact "
        "face, or another contact parameter";
  else
    advice =
        "take more steps, a larger solver.max_cuts or solver.max_iterations; if the load cannot be carried "
        "(a limit load, a body that buckles), prescribe a displacement instead of the force";
  return {fmt::format("{}", fmt::join(findings, "; ")), advice};
}

template Failure diagnose(const Model<2>&, const NewtonReport&);
template Failure diagnose(const Model<3>&, const NewtonReport&);

}  // namespace burnish
