#include "engine/material/material.h"

#include <fmt/format.h>

namespace burnish::inline material {
namespace {

bool has(const std::vector<FieldKind>& fields, const std::string& name) {
  return std::any_of(fields.begin(), fields.end(),
                     [&](const FieldKind& field) { return field.name == name; });
}

}  // namespace

std::vector<CarriedKind> carriedKinds(const MaterialParameters& material) {
  return MaterialLaws::withLaw(material, []<class Law>(std::type_identity<Law>) {
    const auto carried = carriedOf<Law>();
    return std::vector<CarriedKind>(carried.begin(), carried.end());
  });
}

std::vector<FieldKind> materialFields() {
  std::vector<FieldKind> all;
  MaterialLaws::forEachLaw([&]<class Law>(std::type_identity<Law>) {
    for (FieldKind& field : fieldKindsOf<Law>())
      if (!has(all, field.name)) all.push_back(std::move(field));
  });
  return all;
}

std::vector<std::string> materialFieldNames() {
  std::vector<std::string> names;
  for (FieldKind& field : materialFields()) names.push_back(std::move(field.name));
  return names;
}

std::vector<std::string> materialScalarNames() {
  std::vector<std::string> names;
  for (FieldKind& field : materialFields())
    if (field.components.empty()) names.push_back(std::move(field.name));
  return names;
}

std::vector<std::string> materialComponentNames() {
  std::vector<std::string> names;
  for (const FieldKind& field : materialFields()) {
    if (field.components.empty()) names.push_back(field.name);
    for (const std::string& component : field.components) names.push_back(field.name + "." + component);
  }
  return names;
}

std::string whyWithout(const MaterialParameters& material, const std::string& field) {
  const std::string name = field.substr(0, field.find('.'));
  return MaterialLaws::withLaw(material, [&]<class Law>(std::type_identity<Law>) -> std::string {
    if (!has(materialFields(), name) || has(fieldKindsOf<Law>(), name)) return "";
    if (std::is_empty_v<typename Law::State>) return "the material is elastic";
    return fmt::format("{} has no such field", Law::kind.key);
  });
}

void checkMaterial(const MaterialParameters& material, const Problems& problems, bool isInThePlane) {
  std::visit(
      [&](const auto& parameters) {
        if constexpr (requires { check(parameters, problems); }) check(parameters, problems);
        if constexpr (requires { checkInPlane(parameters, problems); })
          if (isInThePlane) checkInPlane(parameters, problems);
      },
      material);
}

}  // namespace burnish::inline material
