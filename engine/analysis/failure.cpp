#include "engine/analysis/failure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <vector>

#include "engine/analysis/free_tools.h"
#include "engine/analysis/release_end.h"
#include "engine/scene/support_names.h"

namespace burnish::inline analysis {
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
    for (std::size_t dof = 0; dof < kAllToolDofs; ++dof)
      if (tool->unknowns[dof] == unknown)
        return fmt::format("tool '{}', {}", tool->name,
                           dof >= kTurn             ? "in its turn"
                           : tool->followsSurface() ? "along the normal"
                                                    : kAxes[dof]);
  return "a constraint";
}

/// What the contact pairs and the faces that may touch themselves did, in `findings`.
struct ContactFindings {
  std::vector<std::string> findings;
  int changes = 0;  ///< of active control points in the last iteration
};

template <int Dim>
ContactFindings contactFindings(const Model<Dim>& model) {
  ContactFindings found;
  for (const auto& pair : model.contacts()) {
    const ContactState& contact = pair.term->state();
    if (contact.active.empty()) continue;
    found.changes += contact.changes;
    found.findings.push_back(fmt::format(
        "{} control points of face {} touch tool '{}', {} changed in the last iteration", contact.numActive(),
        model.faces().textOf(pair.place), model.tools()[pair.tool]->name, contact.changes));
  }
  for (const auto& pair : model.pairs()) {
    const ContactState& contact = pair.term->state();
    if (contact.active.empty()) continue;
    std::vector<std::string> against;
    for (const FacePlace& place : pair.against) against.push_back(model.faces().textOf(place));
    found.changes += contact.changes;
    found.findings.push_back(fmt::format(
        "{} control points of face {} touch face {}, {} changed in the last iteration", contact.numActive(),
        model.faces().textOf(pair.place), fmt::join(against, ", "), contact.changes));
  }
  for (const auto& contact : model.selfContacts()) {
    const ContactState& state = contact.term->state();
    found.changes += state.changes;
    if (state.numActive() > 0 || state.changes > 0)
      found.findings.push_back(
          fmt::format("{} control points of face {} touch the face itself, {} changed in the last iteration",
                      state.numActive(), model.faces().textOf(contact.place), state.changes));
  }
  return found;
}

/// What has happened to tools whose motion is not prescribed.
template <int Dim>
std::vector<std::string> toolFindings(const Model<Dim>& model) {
  std::vector<std::string> findings;
  if (const std::string pulled = pulledTool(model); !pulled.empty())
    findings.push_back(fmt::format(
        "tool '{}' had lost the body: the load that it carries may have pulled it off, or does not "
        "determine its place",
        pulled));
  if (const std::string key = runawayKey(model); !key.empty())
    findings.push_back(fmt::format(
        "{}: the tool would have turned by more than 0.2 radians, or moved by more than the body's size, "
        "in one step, as too little resists it in this way: leave it out of carry, prescribe it, or place "
        "the tool so that it rests on several control points",
        key));
  return findings;
}

/// Supports and tools that are letting go behind time t.
std::vector<std::string> releaseFindings(const Scene& scene, double t) {
  constexpr double kRounding = 1e-9;
  std::vector<std::string> findings;
  const auto add = [&](const char* kind, const std::string& name, const auto& spec, const char* back) {
    const double end = releaseEnd(scene, spec);
    if (spec.until && *spec.until <= t * (1.0 + kRounding) && t < end)
      findings.push_back(fmt::format(
          "{} '{}' was letting go, from t = {:.6g} to {:.6g}: its face is free while forces still press on it, "
          "under which a slender body buckles; {} back to where it carries nothing before it lets go",
          kind, name, *spec.until, end, back));
  };
  const std::vector<std::string> names = supportNames(scene);
  for (std::size_t k = 0; k < names.size(); ++k) add("support", names[k], scene.supports[k], "prescribe it");
  for (const ToolSpec& tool : scene.tools)
    add("tool", tool.name, tool, tool.carry ? "take its load (carry.schedule)" : "move it");
  return findings;
}

/// Whether forces were in balance, and the conditions of contact were not met.
bool leftGaps(const NewtonReport& report, const NewtonOptions& options) {
  return report.outcome == NewtonOutcome::TooManyIterations && report.residual < options.tolerance &&
         report.constraint >= options.constraintTolerance;
}

/// Why the last search ended, with the numbers that decided. gapsRemain: see `leftGaps`.
std::string endOf(const NewtonReport& report, const NewtonOptions& options, bool gapsRemain) {
  if (gapsRemain)
    return fmt::format(
        "forces came into balance (relative residual {:.2e}), but averaged gaps did not vanish under the contact (largest "
        "{:.2e} of the body's size, tolerance {:.0e})",
        report.residual, report.constraint, options.constraintTolerance);
  return fmt::format("{} (last relative residual {:.2e})", describe(report.outcome), report.residual);
}

/// minJ: the smallest J of the last iterate. changes: see `ContactFindings`. gapsRemain: see `leftGaps`.
std::string adviceFor(double minJ, int changes, bool gapsRemain) {
  if (minJ < kDistortedJ)
    return "the mesh is close to folding: give it more knot spans where the body is squeezed, or finer steps";
  if (gapsRemain && changes == 0)
    return "take another contact.method (integral-augmented-lagrangian or augmented-lagrangian), another contact parameter, "
           "or spans along the contact face that are less different in size";
  if (changes > 0)
    return "contact finds no rest: take more steps, a larger solver.max_cuts, more knot spans along the "
           "contact face, or another contact parameter";
  return "take more steps, a larger solver.max_cuts or solver.max_iterations; if the load cannot be carried "
         "(a limit load, a body that buckles), prescribe a displacement instead of the force";
}

}  // namespace

template <int Dim>
Failure diagnose(const Scene& scene, const Simulation<Dim>& simulation) {
  const Model<Dim>& model = *simulation.model;
  const Stepping& stepping = simulation.stepping;
  const NewtonReport& report = stepping.lastFailure();
  const NewtonOptions& options = simulation.newton.options();
  const bool gapsRemain = leftGaps(report, options);
  std::vector<std::string> findings{fmt::format("at t = {:.6g} the smallest step ({:.3g}) failed: {}",
                                                stepping.state().time, stepping.lastFailedStep(),
                                                endOf(report, options, gapsRemain))};
  if (report.worstUnknown >= 0 && !gapsRemain)
    findings.push_back(fmt::format("the residual is largest at {}", placeOf(model, report.worstUnknown)));
  const ContactFindings contact = contactFindings(model);
  std::ranges::copy(contact.findings, std::back_inserter(findings));
  const auto& folding = *std::ranges::min_element(
      model.bodies(), {}, [](const ModelBody<Dim>& body) { return body.bulk->summary().minJ; });
  const double minJ = folding.bulk->summary().minJ;
  findings.push_back(
      fmt::format("the smallest J is {:.3g}{}", minJ,
                  model.bodies().size() > 1 ? fmt::format(", in body '{}'", folding.name) : ""));
  std::ranges::copy(toolFindings(model), std::back_inserter(findings));
  std::ranges::copy(releaseFindings(scene, stepping.state().time), std::back_inserter(findings));
  return {fmt::format("{}", fmt::join(findings, "; ")), adviceFor(minJ, contact.changes, gapsRemain)};
}

template Failure diagnose(const Scene&, const Simulation<2>&);
template Failure diagnose(const Scene&, const Simulation<3>&);

}  // namespace burnish::inline analysis
