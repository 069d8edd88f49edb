#include "engine/analysis/free_tools.h"

#include <fmt/format.h>

namespace burnish {

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
      return fmt::format("tools[{}].carry.{}", load.tool, kCarryKeys[*dof]);
  return {};
}

template std::string pulledTool(const Model<2>&);
template std::string pulledTool(const Model<3>&);
template std::string toolHeldBack(const Model<2>&);
template std::string toolHeldBack(const Model<3>&);
template std::string runawayKey(const Model<2>&);
template std::string runawayKey(const Model<3>&);

}  // namespace burnish
