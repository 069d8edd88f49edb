#include "engine/analysis/free_tools.h"

#include <fmt/format.h>

#include <array>

namespace burnish::inline analysis {

const char* carryKey(const Tool& tool, std::size_t dof) {
  constexpr std::array<const char*, kAllToolDofs> kKeys{"x", "y", "z", "moment", "spin", "spin", "spin"};
  return tool.followsSurface() && dof == kNormal ? "normal" : kKeys[dof];
}

template <int Dim>
std::string pulledTool(const Model<Dim>& model) {
  const double smallest = model.forceFloor();
  for (const auto& pair : model.contacts())
    if (pair.term->state().pull > smallest) return model.tools()[pair.tool]->name;
  return {};
}

template <int Dim>
std::string toolHeldBack(const Model<Dim>& model) {
  for (const auto& load : model.toolLoads())
    if (load.term->carriesTooLittle()) return load.term->tool().name;
  return {};
}

template <int Dim>
std::string runawayKey(const Model<Dim>& model) {
  for (const auto& load : model.toolLoads())
    if (const auto dof = load.term->runaway())
      return fmt::format("tools[{}].carry.{}", load.tool, carryKey(load.term->tool(), *dof));
  return {};
}

template std::string pulledTool(const Model<2>&);
template std::string pulledTool(const Model<3>&);
template std::string toolHeldBack(const Model<2>&);
template std::string toolHeldBack(const Model<3>&);
template std::string runawayKey(const Model<2>&);
template std::string runawayKey(const Model<3>&);

}  // namespace burnish::inline analysis
