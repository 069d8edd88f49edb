#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "engine/scene/quantity_names.h"
#include "engine/scene/support_names.h"
#include "postproc/scene/document_context.h"

namespace burnish {
namespace {

std::vector<std::string> familyNames(const DocumentContext& c) {
  std::vector<std::string> names;
  if (c.document.variants)
    for (const FamilySpec& family : c.document.variants->families) names.push_back(family.name);
  return names;
}

std::size_t numMeshes(const DocumentContext& c) {
  return c.document.variants ? std::max<std::size_t>(1, c.document.variants->meshes.size()) : 1;
}

void checkVariants(const DocumentContext& c) {
  if (!c.document.variants || !c.clean("variants")) return;
  std::set<std::string> names;
  const auto& families = c.document.variants->families;
  for (std::size_t i = 0; i < families.size(); ++i)
    if (!names.insert(families[i].name).second)
      c.report(fmt::format("variants.families[{}].name", i),
               fmt::format("found {}, the name of another family; allowed: a name of its own for each.",
                           families[i].name));
  const auto& meshes = c.document.variants->meshes;
  for (std::size_t i = 1; i < meshes.size(); ++i)
    if (meshes[i].size >= meshes[i - 1].size)
      return c.report(fmt::format("variants.meshes[{}].size", i),
                      fmt::format("found {} after {}; allowed: sizes that decrease from mesh to mesh.",
                                  meshes[i].size, meshes[i - 1].size));
}

/// The value of a formula in the definitions; nothing if something is wrong with it, which is reported.
std::optional<double> constantOf(const CheckContext& c, const std::string& path, const FormulaText& text) {
  checkFormula(c, path, text, true);
  if (!c.clean(path) || !c.clean("definitions")) return {};
  try {
    return Formula(text, c.scene.definitions).constant();
  } catch (const Error& error) {
    c.report(path, fmt::format("{}.", error.what()));
    return {};
  }
}

void checkExpectation(const DocumentContext& c, const std::string& path, const CheckSpec& /*check*/,
                      const ExpectedValue& expect) {
  if (expect.relative.has_value() == expect.absolute.has_value())
    c.report(path, fmt::format("found {} relative and absolute; allowed: exactly one of the two.",
                               expect.relative ? "both" : "none of"));
  const auto value = constantOf(c, path + ".value", expect.value);
  if (value == 0.0 && expect.relative)
    c.report(path + ".relative", "found a deviation relative to the value 0; allowed: absolute.");
}

void checkExpectation(const DocumentContext& c, const std::string& path, const CheckSpec& /*check*/,
                      const ExpectedRange& expect) {
  if (!expect.atLeast && !expect.atMost)
    return c.report(path, "found no bound; allowed: at_least, at_most or both.");
  std::optional<double> low, high;
  if (expect.atLeast) low = constantOf(c, path + ".at_least", *expect.atLeast);
  if (expect.atMost) high = constantOf(c, path + ".at_most", *expect.atMost);
  if (low && high && *low > *high)
    c.report(path + ".at_most",
             fmt::format("found {}; allowed: a bound that is not below at_least, {}.", *high, *low));
}

void checkNumMeshes(const DocumentContext& c, const std::string& path, const char* kind, std::size_t fewest) {
  if (numMeshes(c) < fewest)
    c.report(path + ".expect",
             fmt::format("found {} with {} under variants.meshes; allowed: {} with {} meshes or more.", kind,
                         numMeshes(c) == 1 ? "one mesh" : "two meshes", kind, fewest));
}

void checkExpectation(const DocumentContext& c, const std::string& path, const CheckSpec& /*check*/,
                      const ExpectedOrder& expect) {
  checkNumMeshes(c, path, "order", 3);
  if (expect.limit) constantOf(c, path + ".limit", *expect.limit);
}

void checkExpectation(const DocumentContext& c, const std::string& path, const CheckSpec& /*check*/,
                      const ExpectedTrend& /*expect*/) {
  checkNumMeshes(c, path, "monotone", 2);
}

void checkExpectation(const DocumentContext& c, const std::string& path, const CheckSpec& check,
                      const ExpectedSameness& /*expect*/) {
  const std::size_t families = check.families.empty() ? familyNames(c).size() : check.families.size();
  if (families < 2)
    c.report(path + ".expect",
             fmt::format("found same for {} families; allowed: same with two families or more.", families));
}

void checkFamilies(const DocumentContext& c, const std::string& path, const CheckSpec& check) {
  const std::vector<std::string> names = familyNames(c);
  for (std::size_t i = 0; i < check.families.size(); ++i) {
    const std::string& name = check.families[i];
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    c.report(fmt::format("{}.families[{}]", path, i),
             fmt::format("found {}, but no family has this name; allowed: {}.{}", name,
                         names.empty() ? "a family listed under variants, which has none"
                                       : fmt::format("{}", fmt::join(names, " | ")),
                         didYouMean(name, names)));
  }
}

/// Names of tools, bodies, pairs of faces, measures and listed supports, which the names of columns with a dot begin
/// with.
std::vector<std::string> ownersOfColumns(const Scene& scene) {
  std::vector<std::string> names;
  for (const ToolSpec& tool : scene.tools) names.push_back(tool.name);
  for (const BodySpec& body : scene.bodies) names.push_back(body.name);
  for (const ContactSpec& pair : scene.contact)
    if (!pair.against.empty()) names.push_back(pairName(pair));
  for (const SceneMeasureSpec& measure : scene.measures) names.push_back(measure.name);
  if (scene.output.reactions)
    for (std::string& support : supportNames(scene)) names.push_back(std::move(support));
  return names;
}

void checkColumn(const CheckContext& c, const std::string& path, const std::string& column) {
  const std::size_t dot = column.find('.');
  const std::vector<std::string> owners = ownersOfColumns(c.scene);
  const std::string owner = column.substr(0, dot);
  if (dot == std::string::npos || std::find(owners.begin(), owners.end(), owner) != owners.end()) return;
  const std::vector<std::string> supports = supportNames(c.scene);
  const bool isSupport = std::find(supports.begin(), supports.end(), owner) != supports.end();
  c.report(path,
           fmt::format("found {}, but no tool or measure has the name {}; allowed: {}.{}", column, owner,
                       owners.empty() ? "a scene with tools or measures"
                                      : fmt::format("{}", fmt::join(owners, " | ")),
                       isSupport ? " The history has columns of supports with output: {reactions: true}."
                                 : didYouMean(owner, owners)));
}

/// Columns without a dot are known to the model alone, and so is what stands behind the dot: see
/// `unknownColumns`.
void checkQuantity(const CheckContext& c, const std::string& path, const std::string& quantity) {
  for (const char* owners : {"tools", "bodies", "contact", "measures"})
    if (!c.clean(owners)) return;
  if (!c.clean(path)) return;
  const std::vector<std::string> owners = ownersOfColumns(c.scene);
  const std::string owner = quantity.substr(0, quantity.find('.'));
  if (std::find(owners.begin(), owners.end(), owner) != owners.end()) return;  // the name may have a dash
  try {
    for (const std::string& column : namesInQuantity(quantity)) checkColumn(c, path, column);
  } catch (const Error& problem) {
    c.report(path, problem.what());
  }
}

void checkCheck(const DocumentContext& c, const std::string& path, const CheckSpec& check) {
  checkQuantity(c, path + ".quantity", check.quantity.formula);
  if (c.clean("variants")) checkFamilies(c, path, check);
  const std::optional<double>& time = check.quantity.time;
  if (time && c.clean("steps") && c.clean(path + ".time") && *time > c.scene.steps.back().until)
    c.report(path + ".time", fmt::format("found {}; allowed: a time up to the end of the run at {}.", *time,
                                         c.scene.steps.back().until));
  if (!c.clean("variants") || !c.clean(path)) return;
  std::visit([&](const auto& expect) { checkExpectation(c, path, check, expect); }, check.expect);
}

}  // namespace

void checkChecks(const DocumentContext& c) {
  checkVariants(c);
  for (std::size_t i = 0; i < c.document.checks.size(); ++i)
    checkCheck(c, fmt::format("checks[{}]", i), c.document.checks[i]);
}

}  // namespace burnish
