#include "postproc/draw/contour/field_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "engine/material/material.h"
#include "postproc/mesh/contact_field.h"

namespace burnish {
namespace {

/// How a field is called in a picture.
struct Wording {
  std::string words;
  RichText symbol;  ///< an index for the component is added
  bool isNonNegative = false;
  bool isAboutZero = false;
};

/// A symbol as a `FieldKind` has it, whose letters behind ^ or _ are raised or lowered.
RichText symbolOf(const std::string& text) {
  const std::size_t script = text.find_first_of("^_");
  RichText symbol{{text.substr(0, script)}};
  if (script != std::string::npos)
    symbol.push_back({text.substr(script + 1), text[script] == '^' ? Script::Super : Script::Sub});
  return symbol;
}

std::map<std::string, Wording> allWordings() {
  std::map<std::string, Wording> table{{"displacement", {"Displacement", {{"u"}}, false}},
                                       {"von_mises", {"von Mises stress", symbolOf("σ_v"), true}},
                                       {"stress", {"Cauchy stress", {{"σ"}}, false, true}},
                                       {"pressure", {"Pressure", {{"p"}}, false, true}}};
  table["contact_pressure"] = {"Contact pressure", {{"p"}}, true};
  table["friction_traction"] = {"Traction of friction", symbolOf("t_T"), true};
  table["slip"] = {"Slip in the last step", {{"s"}}, true};
  table["slipped"] = {"Way slipped", {{"s"}}, true};
  table["surface_height"] = {"Height about the mean plane", {{"h"}}, false, true};
  table["sliding"] = {"Contact", {}, true};
  for (const FieldKind& field : materialFields())
    table[field.name] = {field.words, symbolOf(field.symbol), field.isNonNegative};
  return table;
}

const std::map<std::string, Wording>& wordings() {
  static const std::map<std::string, Wording> table = allWordings();
  return table;
}

bool isNonNegative(const std::string& name) {
  const auto wording = wordings().find(name);
  return wording != wordings().end() && wording->second.isNonNegative;
}

bool isAboutZero(const std::string& name) {
  const auto wording = wordings().find(name);
  return wording != wordings().end() && wording->second.isAboutZero;
}

bool isVector(const FieldRecord& field) {
  constexpr std::array axes{"x", "y", "z"};
  return !field.components.empty() && field.components.size() <= axes.size() &&
         std::equal(field.components.begin(), field.components.end(), axes.begin());
}

/// The displacement together with the frame's fields.
std::map<std::string, FieldRecord> allFields(const FrameRecord& frame, const std::string& lengthUnit) {
  std::map<std::string, FieldRecord> fields = frame.fields;
  std::vector<std::string> axes{"x", "y", "z"};
  axes.resize(static_cast<std::size_t>(std::min<Eigen::Index>(3, frame.displacement.rows())));
  fields["displacement"] = {axes, lengthUnit, frame.displacement};
  return fields;
}

std::vector<std::string> namesOf(const std::string& name, const FieldRecord& field) {
  std::vector<std::string> names;
  if (field.components.empty() || isVector(field)) names.push_back(name);
  for (const std::string& component : field.components) names.push_back(name + "." + component);
  return names;
}

std::string wordsOf(const std::string& name, const std::string& component) {
  const auto wording = wordings().find(name);
  const std::string words = wording == wordings().end() ? name : wording->second.words;
  return component.empty() ? words : words + " " + component;
}

RichText titleOf(const std::string& name, const std::string& component, bool magnitude) {
  const auto wording = wordings().find(name);
  if (wording == wordings().end()) {
    if (magnitude) return {{"|" + name + "|"}};
    return component.empty() ? RichText{{name}} : RichText{{name}, {component, Script::Sub}};
  }
  RichText symbol = wording->second.symbol;
  if (!component.empty()) symbol.push_back({component, Script::Sub});
  if (magnitude) {
    symbol.insert(symbol.begin(), {"|"});
    symbol.push_back({"|"});
  }
  RichText title{{wording->second.words + " "}};
  title.insert(title.end(), symbol.begin(), symbol.end());
  return title;
}

}  // namespace

std::vector<std::string> fieldNames(const FrameRecord& frame) {
  std::vector<std::string> names = namesOf("displacement", allFields(frame, "").at("displacement"));
  for (const auto& [name, field] : frame.fields) {
    const auto more = namesOf(name, field);
    names.insert(names.end(), more.begin(), more.end());
  }
  for (std::string& name : contactFieldsOf(frame)) names.push_back(std::move(name));
  return names;
}

std::string fieldToShow(const FrameRecord& frame) {
  return frame.fields.contains("plastic_strain") ? "plastic_strain" : "von_mises";
}

Eigen::VectorXd FieldChoice::scalars(const Eigen::MatrixXd& values) const {
  if (values.rows() > 1) return values.colwise().norm().transpose();
  return values.row(0).transpose();
}

Eigen::VectorXd FieldChoice::drawnScalars(const Eigen::MatrixXd& values) const {
  const Eigen::VectorXd all = scalars(values);
  return isNonNegative ? Eigen::VectorXd(all.cwiseMax(0.0)) : all;
}

double magnitudeOf(const FieldChoice& field) {
  return field.coefficients.size() == 0 ? 0.0 : field.coefficients.cwiseAbs().maxCoeff();
}

void dropRounding(FieldChoice& field, double magnitude) {
  if (magnitudeOf(field) < kRounding * magnitude) field.coefficients.setZero();
}

FieldChoice fieldInWords(const std::string& name, const std::string& component, bool isMagnitude,
                         const std::string& unit) {
  return {.name = component.empty() ? name : name + "." + component,
          .title = titleOf(name, component, isMagnitude),
          .unit = unit,
          .coefficients = {},
          .isNonNegative = component.empty() && isNonNegative(name),
          .isAboutZero = isAboutZero(name),
          .words = wordsOf(name, component)};
}

FieldChoice chooseField(const ModelRecord& model, const FrameRecord& frame, const std::string& name,
                        const char* key) {
  const std::vector<std::string> ofContact = contactFieldsOf(frame);
  if (std::find(ofContact.begin(), ofContact.end(), name) != ofContact.end())
    return {.name = name,
            .title = titleOf(name, "", false),
            .unit = unitOfContactField(model, name),
            .coefficients = {},
            .isNonNegative = true,
            .states = statesOfContactField(name),
            .faces = contactFieldFaces(model, frame, name),
            .words = wordsOf(name, "")};
  const auto fields = allFields(frame, model.lengthUnit);
  for (const auto& [fieldName, field] : fields) {
    const auto names = namesOf(fieldName, field);
    if (std::find(names.begin(), names.end(), name) == names.end()) continue;
    if (name == fieldName)
      return {.name = name,
              .title = titleOf(fieldName, "", isVector(field)),
              .unit = field.unit,
              .coefficients = field.values,
              .isNonNegative = isNonNegative(name),
              .isAboutZero = isAboutZero(name),
              .words = wordsOf(fieldName, "")};
    const std::string component = name.substr(fieldName.size() + 1);
    const auto row = std::find(field.components.begin(), field.components.end(), component);
    return {.name = name,
            .title = titleOf(fieldName, component, false),
            .unit = field.unit,
            .coefficients = field.values.row(row - field.components.begin()),
            .isAboutZero = isAboutZero(fieldName),
            .words = wordsOf(fieldName, component)};
  }
  std::vector<std::string> names = fieldNames(frame);
  if (std::string_view(key) != "field")  // faces have their fields to themselves
    std::erase_if(names, [&](const std::string& one) { return isContactField(one); });
  throw Error(fmt::format("{}: found \"{}\"; available in frame {}: {}.{}", key, name, frame.index,
                          fmt::join(names, ", "), didYouMean(name, names)));
}

}  // namespace burnish
