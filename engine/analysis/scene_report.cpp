#include "engine/analysis/scene_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "engine/analysis/build_model.h"
#include "engine/analysis/check_columns.h"
#include "engine/analysis/cost_estimate.h"
#include "engine/analysis/frames.h"
#include "engine/analysis/history_columns.h"
#include "engine/analysis/locking.h"
#include "engine/analysis/measures.h"
#include "engine/analysis/model.h"
#include "engine/analysis/nearest_point.h"
#include "engine/analysis/reactions.h"
#include "engine/analysis/simulation.h"
#include "engine/analysis/softening.h"
#include "engine/analysis/summarise.h"
#include "engine/analysis/unrecovered.h"
#include "engine/scene/path_mesh.h"
#include "engine/scene/scene_places.h"

namespace burnish::inline analysis {
namespace {

template <int Dim>
std::string summaryOf(const Scene& scene, const Model<Dim>& model) {
  std::vector<std::string> names;
  for (const auto& tool : model.tools()) names.push_back(tool->name);
  const char* kinematics = Dim == 3 ? "" : model.body().axisymmetric ? ", axisymmetric" : ", plane strain";
  std::vector<std::string> bases;
  for (const BodySpec& body : scene.allBodies())
    bases.push_back(
        fmt::format("{}{} of degree {}", body.name.empty() ? "" : fmt::format("body {}: ", body.name),
                    body.basis == BasisChoice::Nurbs ? "NURBS" : "Lagrange elements", body.degree));
  return fmt::format(
      "{} dimensions{}, {}, {} unknowns, {}", Dim, kinematics, fmt::join(bases, ", "), numEquations(model),
      names.empty() ? "no tools"
                    : fmt::format("{} {}", names.size() == 1 ? "tool" : "tools", fmt::join(names, ", ")));
}

/// Whether the body stays where it is as long as no tool touches it.
bool restsByItself(const Scene& scene) {
  return scene.loads.empty() && std::none_of(scene.supports.begin(), scene.supports.end(),
                                             [](const SupportSpec& s) { return s.move || s.prescribe; });
}

/// Smallest gap between the undeformed faces of a tool's pairs and the tool on its way; 0 when it touches
/// one.
template <int Dim>
double smallestGap(const Model<Dim>& model, std::size_t number, double end) {
  constexpr int kSamples = 50;
  std::vector<double> times = model.corners();
  for (int k = 0; k <= kSamples; ++k) times.push_back(end * k / kSamples);
  double smallest = std::numeric_limits<double>::infinity();
  for (const double t : times)
    for (const ContactPair<Dim>& pair : model.contacts()) {
      if (pair.tool != number || t < 0.0 || t > end) continue;
      smallest = std::min(smallest, nearestPoint(model.body(), pair.place, *model.tools()[number], t).gap);
      if (smallest <= kTouching * model.body().size()) return 0.0;
    }
  return smallest;
}

template <int Dim>
std::vector<InputProblem> toolWarnings(const Scene& scene, const Model<Dim>& model) {
  const double end = scene.steps.back().until;
  std::vector<InputProblem> warnings;
  for (std::size_t k = 0; k < model.tools().size(); ++k) {
    const Tool& tool = *model.tools()[k];
    const std::string path = fmt::format("tools[{}]", k);
    const bool named = std::any_of(model.contacts().begin(), model.contacts().end(),
                                   [k](const ContactPair<Dim>& pair) { return pair.tool == k; });
    if (!named) {
      warnings.push_back(
          {path, fmt::format("no face can touch tool '{}'; name it under contact", tool.name)});
      continue;
    }
    if (!tool.freeUnknowns().empty() || !restsByItself(scene)) continue;
    if (const double gap = smallestGap(model, k, scene.tools[k].until.value_or(end)); gap > 0.0)
      warnings.push_back({path, fmt::format("tool '{}' stays {:.3g} or more away from the faces that may "
                                            "touch it as long as these are undeformed; move it closer",
                                            tool.name, gap)});
  }
  return warnings;
}

/// Of boxes whose ends are too near to the passes that their mesh is made for.
std::vector<InputProblem> roomWarnings(const Scene& scene) {
  std::vector<InputProblem> warnings;
  for (std::size_t k = 0; k < scene.allBodies().size(); ++k) {
    if (!scene.allBodies()[k].geometry.mesh.resolution) continue;
    const auto [beside, below] = pathRoom(scene, k);
    const auto warn = [&](const char* where, double found, double wanted) {
      if (found < wanted)
        warnings.push_back(
            {scene.bodyKey(k, "geometry.resolution"),
             fmt::format("the box ends {:.2g} half widths of the contact {} the passes, where the stress "
                         "that they leave still feels it; make it larger by {:.2g} of them",
                         found, where, wanted - found)});
    };
    warn("beside", beside, kRoomBeside);
    warn("below", below, kRoomBelow);
  }
  return warnings;
}

/// Of forces that fade until the end of the run, during which bodies keep their meshes.
std::vector<InputProblem> fadingWarnings(const Scene& scene) {
  std::vector<InputProblem> warnings;
  if (!scene.rezoning) return warnings;
  const auto warn = [&](const auto& specs, const char* list, const char* what) {
    for (std::size_t k = 0; k < specs.size(); ++k)
      if (specs[k].until && !specs[k].releasedBy)
        warnings.push_back(
            {fmt::format("{}[{}].until", list, k),
             fmt::format("from t = {:.4g} to the end of the run, while the force of the {} goes "
                         "to zero, the body keeps its mesh; with released_by that ends sooner",
                         *specs[k].until, what)});
  };
  warn(scene.supports, "supports", "support");
  if (scene.tools.size() > 1) warn(scene.tools, "tools", "tool");
  return warnings;
}

/// Of tools whose force goes to zero although it alone holds them.
std::vector<InputProblem> unloadedToolWarnings(const Scene& scene) {
  std::vector<InputProblem> warnings;
  for (std::size_t k = 0; k < scene.tools.size(); ++k) {
    const auto& carry = scene.tools[k].carry;
    if (!carry || !carry->schedule) continue;
    const std::vector<double>& values = carry->schedule->values;
    const auto loaded = std::ranges::find_if(values, [](double value) { return value != 0.0; });
    const auto zero = std::find(loaded, values.end(), 0.0);
    if (zero == values.end()) continue;
    const auto at = zero - values.begin();
    warnings.push_back(
        {fmt::format("tools[{}].carry.schedule.values[{}]", k, at),
         fmt::format(
             "without its force nothing holds tool '{}' in its place, and steps near t = {:.4g} may find no "
             "equilibrium; `until: {:.4g}` of the tool takes it away, and its force with it little by little, "
             "or let the schedule end at a small share, such as 0.01",
             scene.tools[k].name, carry->schedule->times[static_cast<std::size_t>(at)],
             at > 0 ? carry->schedule->times[static_cast<std::size_t>(at) - 1] : 0.0)});
  }
  return warnings;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

/// As a run has them, without the projections that only measures need.
template <int Dim>
std::vector<std::string> columnsOf(const Scene& scene, const Model<Dim>& model) {
  const auto projections = scene.measures.empty() ? std::vector<Projection<Dim>>() : projectionsOf(model);
  const Measures<Dim> measures(scene, model, projections);
  std::vector<std::string> names;
  for (HistoryColumn& column :
       historyColumns(scene, model, Reactions<Dim>(scene, model).columns(), measures.columns()))
    names.push_back(std::move(column.name));
  return names;
}

template <int Dim>
SceneReport reportInDimension(const Scene& scene) {
  const auto model = buildModel<Dim>(scene);
  std::vector<std::string> columns = columnsOf(scene, *model);
  requireKnownColumns(scene, columns);
  std::vector<std::string> warnings = warningLines(scene, sceneWarnings(scene, *model, columns));
  return {summaryOf(scene, *model), std::move(warnings), std::move(columns), makeModelRecord(scene, *model),
          estimateCost(scene, *model)};
}

}  // namespace

template <int Dim>
std::vector<InputProblem> sceneWarnings(const Scene& scene, const Model<Dim>& model,
                                        const std::vector<std::string>& columns) {
  std::vector<InputProblem> warnings = lockingWarnings(scene, model);
  for (std::size_t k = 0; k < model.bodies().size(); ++k)
    for (auto& [path, text] : softeningWarnings(model.bodies()[k].bulk->material()))
      warnings.push_back({scene.bodyKey(k, path), std::move(text)});
  for (std::size_t k = 0; k < scene.allBodies().size(); ++k)
    for (auto& [path, text] : recoveryWarnings(scene.allBodies()[k].material))
      warnings.push_back({scene.bodyKey(k, path), std::move(text)});
  std::ranges::move(roomWarnings(scene), std::back_inserter(warnings));
  std::ranges::move(toolWarnings(scene, model), std::back_inserter(warnings));
  std::ranges::move(fadingWarnings(scene), std::back_inserter(warnings));
  std::ranges::move(unloadedToolWarnings(scene), std::back_inserter(warnings));
  if (scene.wanted.onlyWarns) std::ranges::move(unknownColumns(scene, columns), std::back_inserter(warnings));
  return warnings;
}

void requireKnownColumns(const Scene& scene, const std::vector<std::string>& columns) {
  if (scene.wanted.onlyWarns) return;
  const auto problems = unknownColumns(scene, columns);
  if (!problems.empty()) throw Error(textWithPlaces(scene, problems));
}

std::vector<std::string> warningLines(const Scene& scene, const std::vector<InputProblem>& warnings) {
  return linesOf(textWithPlaces(scene, warnings));
}

SceneReport reportOf(const Scene& scene) {
  return scene.dim() == 2 ? reportInDimension<2>(scene) : reportInDimension<3>(scene);
}

std::vector<std::string> historyColumnsOf(const Scene& scene) {
  return scene.dim() == 2 ? columnsOf(scene, *buildModel<2>(scene)) : columnsOf(scene, *buildModel<3>(scene));
}

template std::vector<InputProblem> sceneWarnings<2>(const Scene&, const Model<2>&,
                                                    const std::vector<std::string>&);
template std::vector<InputProblem> sceneWarnings<3>(const Scene&, const Model<3>&,
                                                    const std::vector<std::string>&);

}  // namespace burnish::inline analysis
