#include "postproc/compare/data/data_json.h"

#include <fmt/format.h>
#include <json/value.h>

#include <cmath>

#include "postproc/compare/comparison_json.h"

namespace burnish {
namespace {

Json::Value numberJson(double value) {
  return std::isfinite(value) ? Json::Value(value) : Json::Value(fmt::format("{}", value));
}

Json::Value textJson(const std::string& text) {
  return text.empty() ? Json::Value() : Json::Value(text);
}

Json::Value fieldJson(const DataPair& pair, const FieldComparison& field) {
  Json::Value value;
  value["result"] = textJson(pair.name);
  value["name"] = field.name;
  value["verdict"] = verdictName(field.verdict);
  value["message"] = field.message;
  value["allowed"] = numberJson(field.allowed);
  value["differing"] = static_cast<Json::Int64>(field.differing);
  value["compared"] = static_cast<Json::Int64>(field.compared);
  for (const char* key :
       {"time", "place", "number", "owner", "component", "position", "actual", "baseline", "difference"})
    value[key] = Json::nullValue;
  if (!field.worst) return value;
  const WorstPlace& worst = *field.worst;
  if (worst.time) value["time"] = *worst.time;
  value["place"] = textJson(worst.place);
  if (!worst.place.empty()) value["number"] = static_cast<Json::Int64>(worst.number);
  value["owner"] = textJson(worst.owner);
  value["component"] = textJson(worst.component);
  for (const double coordinate : worst.position) value["position"].append(numberJson(coordinate));
  value["actual"] = numberJson(worst.actual);
  value["baseline"] = numberJson(worst.baseline);
  value["difference"] = numberJson(worst.difference);
  return value;
}

}  // namespace

std::string fieldsText(const std::vector<ResultComparison>& comparisons) {
  constexpr int kAllDigits = 17;
  std::vector<Json::Value> values;
  for (const auto& [pair, fields] : comparisons)
    for (const FieldComparison& field : fields) values.push_back(fieldJson(pair, field));
  return listText(values, kAllDigits);
}

}  // namespace burnish
