#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/check_context.h"

/// Checks that supports, loads and tools share.
namespace burnish::inline scene {

/// Keys and values of the components of a motion or a load that may be left out.
template <class T>
using Components = std::vector<std::pair<const char*, const std::optional<T>*>>;

template <class Spec>
auto componentsOf(const Spec& s) {
  using T = typename decltype(s.x)::value_type;
  return Components<T>{{"x", &s.x}, {"y", &s.y}, {"z", &s.z}};
}

/// When a support or a tool lets go, and by when its force is gone.
template <class Spec>
void checkRelease(const CheckContext& c, const std::string& path, const Spec& spec) {
  const std::string until = path + ".until", by = path + ".released_by";
  if (!c.clean("steps") || !c.clean(until) || !c.clean(by)) return;
  const double end = c.scene.steps.back().until;
  if (spec.until && *spec.until >= end)
    return c.report(
        until, fmt::format("found {}; allowed: a time before the end of the run at {}.", *spec.until, end));
  if (!spec.releasedBy) return;
  if (!spec.until) return c.report(by, "found without until; allowed: beside until, and after it.");
  if (*spec.releasedBy <= *spec.until || *spec.releasedBy > end)
    c.report(by, fmt::format("found {}; allowed: a time after until ({}) and up to the end of the run at {}.",
                             *spec.releasedBy, *spec.until, end));
}

/// One component or more, and none that the scene has no room for.
template <class T>
void checkPresence(const CheckContext& c, const std::string& path, const Components<T>& components) {
  bool any = false;
  std::vector<std::string> keys;
  for (const auto& [key, component] : components) {
    any |= component->has_value();
    keys.emplace_back(key);
  }
  if (!any && c.clean(path))
    c.report(path, fmt::format("found no component; allowed: one or more of {}.", fmt::join(keys, ", ")));
  for (const auto& [key, component] : components)
    if (*component && std::string(key) == "z" && c.dimensionIsKnown() && c.scene.dim() == 2)
      c.report(path + ".z", "found a component of three-dimensional scenes; allowed here: x and y.");
}

inline void checkLength(const CheckContext& c, const std::string& path, std::size_t values,
                        std::size_t times) {
  if (c.clean(path) && values != times)
    c.report(path, fmt::format("found {} values for {} times; allowed: one value for each of the times.",
                               values, times));
}

inline void checkSchedule(const CheckContext& c, const std::string& path, const Schedule& schedule) {
  checkLength(c, path + ".values", schedule.values.size(), schedule.times.size());
}

/// Components as tables over the same times.
inline void checkTable(const CheckContext& c, const std::string& path, const std::vector<double>& times,
                       const Components<std::vector<double>>& components) {
  checkPresence(c, path, components);
  for (const auto& [key, component] : components)
    if (*component && c.clean(path + ".times"))
      checkLength(c, fmt::format("{}.{}", path, key), (*component)->size(), times.size());
}

/// Formulas, each judged by `check`.
template <class Check>
void checkEachFormula(const CheckContext& c, const std::string& path,
                      const Components<FormulaText>& components, const Check& check) {
  for (const auto& [key, component] : components)
    if (*component) check(c, fmt::format("{}.{}", path, key), **component);
}

/// Components as formulas, each judged by `check`.
template <class Check>
void checkFormulas(const CheckContext& c, const std::string& path, const Components<FormulaText>& components,
                   const Check& check) {
  checkPresence(c, path, components);
  checkEachFormula(c, path, components, check);
}

}  // namespace burnish::inline scene
