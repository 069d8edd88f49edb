#include "engine/analysis/locking.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace burnish::inline analysis {
namespace {

/// Poisson's ratios from which the displacement formulation of degree 1, 2, … (the last: and higher) is more
/// than 5 % too stiff on a mesh of 16 x 8 spans; docs/scene.md has the measurements.
constexpr std::array kLockingRatios{0.45, 0.49, 0.499, 0.4999};

template <int Dim>
int lowestDegree(const Body<Dim>& body) {
  int lowest = body.patches.front().basis().direction(0).degree();
  for (const auto& patch : body.patches)
    for (int d = 0; d < Dim; ++d) lowest = std::min(lowest, patch.basis().direction(d).degree());
  return lowest;
}

double lockingRatio(int degree) {
  const auto last = static_cast<int>(kLockingRatios.size());
  return kLockingRatios[static_cast<std::size_t>(std::min(degree, last) - 1)];
}

/// What a scene gives for the resistance to changes of volume: its key, and its value in words.
std::pair<std::string, std::string> volumeConstant(const MaterialParameters& material, double nu) {
  const std::optional<double> kappa = std::visit(
      [](const auto& law) -> std::optional<double> {
        if constexpr (requires { law.kappa; }) return law.kappa;
        return std::nullopt;
      },
      material);
  if (!kappa) return {"nu", fmt::format("{:.6g}", nu)};
  return {"kappa", fmt::format("{:.6g}, a Poisson's ratio of {:.6g},", *kappa, nu)};
}

}  // namespace

template <int Dim>
std::vector<InputProblem> lockingWarnings(const Scene& scene, const Model<Dim>& model) {
  std::vector<InputProblem> warnings;
  for (std::size_t k = 0; k < model.bodies().size(); ++k) {
    if (scene.allBodies()[k].formulation != Formulation::Displacement) continue;
    const Material material = model.bodies()[k].bulk->material();
    const double nu = poissonsRatio(material);
    const int degree = lowestDegree(model.bodies()[k].body);
    const auto [key, value] = volumeConstant(scene.allBodies()[k].material, nu);
    if (nu >= lockingRatio(degree))
      warnings.push_back(
          {scene.bodyKey(k, "material." + key),
           fmt::format("{} is nearly incompressible: the displacement formulation of degree {} locks from {} "
                       "on, its forces are too large by 5 % and more; add formulation: fbar",
                       value, degree, lockingRatio(degree))});
    if (flows(material))
      warnings.push_back(
          {scene.bodyKey(k, "material.law"),
           "plastic flow is nearly incompressible: where the body flows, pressures of the displacement "
           "formulation oscillate from span to span, and forces are too large; add formulation: fbar"});
  }
  return warnings;
}

template std::vector<InputProblem> lockingWarnings<2>(const Scene&, const Model<2>&);
template std::vector<InputProblem> lockingWarnings<3>(const Scene&, const Model<3>&);

}  // namespace burnish::inline analysis
