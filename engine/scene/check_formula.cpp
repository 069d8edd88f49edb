#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <unordered_set>

#include "engine/contact/friction_law.h"
#include "engine/core/definitions.h"
#include "engine/core/error.h"
#include "engine/core/formula_words.h"
#include "engine/core/nearest.h"
#include "engine/core/quoted.h"
#include "engine/scene/check_context.h"

namespace burnish::inline scene {
namespace {

/// Other names would be taken apart, without a word.
bool isVariableName(const std::string& name) {
  const auto isPart = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  return !name.empty() && std::isalpha(static_cast<unsigned char>(name.front())) != 0 &&
         std::all_of(name.begin(), name.end(), isPart);
}

}  // namespace

void checkFormula(const CheckContext& c, const std::string& path, const FormulaText& text, bool constant) {
  if (!c.clean(path) || !c.clean("definitions")) return;
  try {
    const Formula formula(text, c.scene.definitions);
    for (const char* variable : {"X", "Y", "Z", "t"})
      if (constant && formula.dependsOn(variable))
        return c.report(
            path,
            fmt::format(
                "found {}, which depends on {}; allowed: a number or a formula in the definitions alone.",
                quoted(text.text), variable));
    if (c.dimensionIsKnown() && c.scene.dim() == 2 && formula.dependsOn("Z"))
      c.report(path, fmt::format("found {}, which depends on Z; allowed in two dimensions: X, Y and t.",
                                 quoted(text.text)));
  } catch (const Error& problem) {
    c.report(path, fmt::format("{}.", problem.what()));
  }
}

void checkFrictionFormula(const CheckContext& c, const std::string& path, const ContactOptions& options) {
  if (!options.friction || !c.clean(path) || !c.clean("definitions")) return;
  try {
    static_cast<void>(FrictionLaw(options, c.scene.definitions));
  } catch (const FormulaError& problem) {
    c.report(path,
             fmt::format("found {}; allowed: a number at least 0, or a formula in {} and the definitions.",
                         quoted(options.friction->text), fmt::join(FrictionLaw::variables(), ", ")));
  } catch (const Error& problem) {
    c.report(path, fmt::format("{}.", problem.what()));
  }
}

void checkTimeFormula(const CheckContext& c, const std::string& path, const FormulaText& text) {
  checkFormula(c, path, text);
  if (!c.clean(path) || !c.clean("definitions")) return;
  const Formula formula(text, c.scene.definitions);
  for (const char* variable : {"X", "Y", "Z"})
    if (formula.dependsOn(variable))
      return c.report(path, fmt::format("found {}, which depends on {}; allowed: t and the definitions.",
                                        quoted(text.text), variable));
}

bool checkBodyName(const CheckContext& c, const std::string& at, const std::string& body) {
  const std::string path = at + ".body";
  if (!c.clean(path) || !c.bodiesAreRead()) return false;
  if (c.scene.bodies.empty()) {
    if (!body.empty())
      c.report(path,
               fmt::format("found {}, but the one body of the scene has no name; allowed: leave the key "
                           "out.",
                           body));
    return body.empty();
  }
  if (body.empty() && c.scene.bodies.size() == 1) return true;
  std::vector<std::string> names;
  for (const BodySpec& spec : c.scene.bodies) names.push_back(spec.name);
  if (std::ranges::find(names, body) != names.end()) return true;
  c.report(path, fmt::format("{}; allowed: {}.{}", body.empty() ? "missing" : "found " + body,
                             fmt::join(names, " | "), didYouMean(body, names)));
  return false;
}

void checkPatch(const CheckContext& c, const std::string& at, const std::string& body,
                const std::string& patch) {
  const std::string path = at + ".patch";
  if (!checkBodyName(c, at, body) || !c.clean(path)) return;
  const std::size_t number = c.scene.bodyNumber(body);
  if (!c.clean(c.scene.bodyKey(number, "geometry"))) return;
  const auto* several = std::get_if<PatchesSpec>(&c.scene.allBodies()[number].geometry.shape);
  if (several == nullptr) {
    if (!patch.empty())
      c.report(path,
               fmt::format("found {}, but the body has a single patch; allowed: leave the key out.", patch));
    return;
  }
  std::vector<std::string> names;
  for (const PatchSpec& spec : several->patches) names.push_back(spec.name);
  if (std::find(names.begin(), names.end(), patch) == names.end())
    c.report(path, fmt::format("{}; allowed: {}.{}", patch.empty() ? "missing" : "found " + patch,
                               fmt::join(names, " | "), didYouMean(patch, names)));
}

void checkDefinitions(const CheckContext& c) {
  std::unordered_set<std::string> taken{"X", "Y", "Z", "t", "s"};
  const auto functions = formulaFunctions();
  for (std::size_t k = 0; k < c.scene.definitions.size(); ++k) {
    const std::string& name = c.scene.definitions[k].name;
    const std::string path = fmt::format("definitions[{}]", k);
    if (!c.clean(path)) continue;
    if (!taken.insert(name).second)
      c.report(path + ".name",
               fmt::format("found {}, which already has a meaning; allowed: another name.", shortened(name)));
    if (!isVariableName(name) || std::find(functions.begin(), functions.end(), name) != functions.end())
      c.report(path + ".name", fmt::format("found {}; allowed: a letter, then letters, digits and _, and not "
                                           "the name of a function such as min.",
                                           shortened(name)));
  }
  if (!c.clean("definitions")) return;
  for (const DefinitionProblem& problem : problemsOf(c.scene.definitions))
    c.report(fmt::format("definitions[{}].formula", problem.definition), fmt::format("{}.", problem.text));
}

}  // namespace burnish::inline scene
