#include "engine/schema/json_schema.h"

#include <fmt/format.h>
#include <json/value.h>
#include <json/writer.h>
#include <yaml-cpp/yaml.h>

#include <map>

namespace burnish::inline schema {
namespace {

using Kind = ValueType::Kind;

/// Of a number that is given as a formula of the constants pi or e.
constexpr const char* kConstantPattern = "(^|[^A-Za-z0-9_])(pi|e)([^A-Za-z0-9_]|$)";

Json::Value names(const std::vector<std::string>& texts) {
  Json::Value list(Json::arrayValue);
  for (const std::string& text : texts) list.append(text);
  return list;
}

/// A default, which the declaration has as YAML.
Json::Value jsonOf(const YAML::Node& yaml, Kind kind) {
  if (yaml.IsSequence()) {
    Json::Value list(Json::arrayValue);
    for (const auto& entry : yaml) list.append(jsonOf(entry, kind));
    return list;
  }
  if (kind == Kind::Truth) return yaml.as<bool>();
  if (kind == Kind::Whole) return yaml.as<int>();
  if (kind == Kind::Number) return yaml.as<double>();
  return yaml.Scalar();
}

void setRange(Json::Value& schema, const Rule& rule) {
  if (rule.above) schema["exclusiveMinimum"] = *rule.above;
  if (rule.atLeast) schema["minimum"] = *rule.atLeast;
  if (rule.below) schema["exclusiveMaximum"] = *rule.below;
  if (rule.atMost) schema["maximum"] = *rule.atMost;
}

Json::Value mappingSchema(const Declarations& keys);

/// A single value, outside of lists.
Json::Value entrySchema(const Declaration& key) {
  Json::Value schema;
  switch (key.type.kind) {
    case Kind::Truth:
      schema["type"] = "boolean";
      break;
    case Kind::Whole:
      schema["type"] = "integer";
      setRange(schema, key.rule);
      break;
    case Kind::Number:
      schema["type"] = names({"number", "string"});
      schema["pattern"] = key.key == "time" || key.key == "times"
                              ? std::string(kConstantPattern) + "|^(end|last)$"
                              : kConstantPattern;
      setRange(schema, key.rule);
      break;
    case Kind::Formula:
      schema["type"] = names({"number", "string"});
      break;
    case Kind::Choice:
      schema["enum"] = names(key.rule.choices);
      break;
    case Kind::Mapping:
      return mappingSchema(key.below);
    case Kind::Text:
      if (!key.rule.choices.empty()) {
        schema["enum"] = names(key.rule.choices);
        break;
      }
      schema["type"] = names({"string", "number"});  // YAML takes a text such as 12 for a number
      if (key.rule.identifier) schema["pattern"] = "^[A-Za-z0-9_-]+$";
      if (const std::size_t most = key.rule.mostLetters(); most > 0)
        schema["maxLength"] = static_cast<Json::UInt64>(most);
      break;
  }
  return schema;
}

Json::Value listSchema(Json::Value items, std::size_t fewest, std::size_t most) {
  Json::Value schema;
  schema["type"] = "array";
  schema["items"] = std::move(items);
  if (fewest > 0) schema["minItems"] = static_cast<Json::UInt64>(fewest);
  if (most > 0) schema["maxItems"] = static_cast<Json::UInt64>(most);
  return schema;
}

Json::Value valueSchema(const Declaration& key) {
  constexpr std::size_t kFewestDimensions = 2, kMostDimensions = 3;
  Json::Value schema = entrySchema(key);
  for (int inner = 1; inner < key.type.lists; ++inner) schema = listSchema(std::move(schema), 0, 0);
  const Json::Value single = schema;
  if (key.type.lists > 0) {
    const std::size_t length = key.type.length;
    const bool fixed = length > 0, dimensional = key.rule.perDimension;
    schema = listSchema(std::move(schema),
                        fixed         ? length
                        : dimensional ? kFewestDimensions
                                      : key.rule.minEntries,
                        fixed         ? length
                        : dimensional ? kMostDimensions
                                      : key.rule.maxEntries);
  }
  if (key.type.singleToo) {
    Json::Value either;
    either["anyOf"].append(single);
    either["anyOf"].append(std::move(schema));
    schema = std::move(either);
  }
  const std::string unit = key.rule.unit.empty() ? "" : fmt::format(" Unit: {}.", key.rule.unit);
  schema["description"] = fmt::format("{} Allowed: {}.{}", key.sentence, key.allowed, unit);
  if (key.defaultValue) schema["default"] = jsonOf(YAML::Load(*key.defaultValue), key.type.kind);
  return schema;
}

Json::Value emptyMapping() {
  Json::Value schema;
  schema["type"] = "object";
  schema["properties"] = Json::objectValue;
  schema["additionalProperties"] = false;
  return schema;
}

/// Keys that are required unless another one stands in their place.
void addReplaced(Json::Value& schema, const Declarations& keys) {
  std::map<std::string, Json::Value> replaced;
  for (const Declaration& key : keys)
    if (key.rule.required && !key.rule.unless.empty()) replaced[key.rule.unless].append(key.key);
  for (const auto& [instead, required] : replaced) {
    Json::Value with, without;
    with["required"].append(instead);
    without["required"] = required;
    schema["anyOf"].append(without);
    schema["anyOf"].append(with);
  }
}

void addKeys(Json::Value& schema, const Declarations& keys) {
  for (const Declaration& key : keys) {
    schema["properties"][key.key] = valueSchema(key);
    if (key.rule.required && key.rule.unless.empty()) schema["required"].append(key.key);
  }
  addReplaced(schema, keys);
}

/// The keys of an alternative when it is chosen; the common ones, which are described outside, may stand
/// beside them.
Json::Value alternativeSchema(const std::string& chooser, const DeclaredAlternative& alternative,
                              const Json::Value& common) {
  Json::Value own = emptyMapping();
  addKeys(own, alternative.keys);
  own.removeMember("type");
  for (const std::string& key : common.getMemberNames()) own["properties"][key] = true;
  Json::Value schema;
  schema["if"]["properties"][chooser]["const"] = alternative.about.name;
  schema["if"]["required"].append(chooser);
  schema["then"] = std::move(own);
  return schema;
}

/// Describes the names that a key may have one by one, as editors show them.
void describeChoices(Json::Value& schema, const Declaration& chooser) {
  std::string text = chooser.sentence;
  for (const DeclaredAlternative& alternative : chooser.alternatives)
    text += fmt::format("\n{}: {}", alternative.about.name, alternative.about.sentence);
  schema["properties"][chooser.key]["description"] = text;
}

Json::Value mappingSchema(const Declarations& keys) {
  Json::Value schema = emptyMapping();
  addKeys(schema, keys);
  const Json::Value common = schema["properties"];
  for (const Declaration& key : keys) {
    if (key.alternatives.empty()) continue;
    schema.removeMember("additionalProperties");  // each alternative says which keys there are
    describeChoices(schema, key);
    for (const DeclaredAlternative& alternative : key.alternatives)
      schema["allOf"].append(alternativeSchema(key.key, alternative, common));
  }
  return schema;
}

}  // namespace

std::string jsonSchema(const std::string& title, const Declarations& keys) {
  Json::Value schema = mappingSchema(keys);
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  schema["title"] = title;
  Json::StreamWriterBuilder builder;
  builder["commentStyle"] = "None";  // short lists in one line
  builder["indentation"] = " ";
  builder["precision"] = 15;
  return Json::writeString(builder, schema) + "\n";
}

}  // namespace burnish::inline schema
