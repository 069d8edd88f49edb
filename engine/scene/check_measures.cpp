#include <fmt/format.h>

#include <set>

#include "engine/scene/check_context.h"

namespace burnish::inline scene {
namespace {

/// A field of another material.
void checkMaterialField(const CheckContext& c, const std::string& path, const std::string& body,
                        const std::string& field) {
  const std::size_t number = c.scene.bodyNumber(body);
  if (!c.bodiesAreRead() || !c.clean(path) || !c.clean(c.scene.bodyKey(number, "material"))) return;
  if (const std::string why = whyWithout(c.scene.allBodies()[number].material, field); !why.empty())
    c.report(path, fmt::format("found {}, but {}; allowed here: another field.", field, why));
}

void checkKind(const CheckContext& c, const std::string& path, const PointMeasureSpec& point) {
  if (point.parameters.empty() == point.position.empty() && c.clean(path))
    c.report(path, fmt::format("found {}; allowed: exactly one of parameters and position.",
                               point.position.empty() ? "neither parameters nor position" : "both"));
  if (!point.patch.empty() || point.position.empty())
    checkPatch(c, path, point.body, point.patch);
  else
    checkBodyName(c, path, point.body);
  for (std::size_t k = 0; k < point.fields.size(); ++k)
    checkMaterialField(c, fmt::format("{}.fields[{}]", path, k), point.body, point.fields[k]);
}

void checkKind(const CheckContext& c, const std::string& path, const FaceMeasureSpec& face) {
  checkFace(c, path, face.place);
}

void checkKind(const CheckContext& c, const std::string& path, const ErrorMeasureSpec& error) {
  checkBodyName(c, path, error.body);
  for (std::size_t d = 0; d < error.displacement.size(); ++d)
    checkFormula(c, fmt::format("{}.displacement[{}]", path, d), error.displacement[d]);
}

void checkKind(const CheckContext& c, const std::string& path, const EllipseMeasureSpec& ellipse) {
  checkFace(c, path, ellipse.place);
}

void checkKind(const CheckContext& c, const std::string& path, const ExtentMeasureSpec& extent) {
  checkFace(c, path, extent.place);
}

void checkKind(const CheckContext& c, const std::string& path, const PercentileMeasureSpec& percentile) {
  checkBodyName(c, path, percentile.body);
  checkMaterialField(c, path + ".field", percentile.body, percentile.field);
}

}  // namespace

void checkMeasures(const CheckContext& c) {
  std::set<std::string> names;
  for (const auto& tool : c.scene.tools) names.insert(tool.name);
  for (const auto& body : c.scene.bodies) names.insert(body.name);
  for (std::size_t k = 0; k < c.scene.measures.size(); ++k) {
    const auto& measure = c.scene.measures[k];
    const std::string path = fmt::format("measures[{}]", k);
    if (c.clean(path + ".name") && !names.insert(measure.name).second)
      c.report(path + ".name",
               fmt::format("found {}, the name of another measure, body or tool; allowed: a name of its own.",
                           measure.name));
    if (c.clean(path + ".kind"))
      std::visit([&](const auto& kind) { checkKind(c, path, kind); }, measure.kind);
  }
}

}  // namespace burnish::inline scene
