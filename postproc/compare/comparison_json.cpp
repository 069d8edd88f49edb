#include "postproc/compare/comparison_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <json/writer.h>

namespace burnish {
namespace {

Json::Value boxJson(const PixelBox& box) {
  if (box.width == 0) return Json::nullValue;
  Json::Value value;
  value["x"] = box.left;
  value["y"] = box.top;
  value["width"] = box.width;
  value["height"] = box.height;
  return value;
}

}  // namespace

Json::Value comparisonJson(const Comparison& comparison, const PictureRule& rule) {
  Json::Value value;
  value["name"] = comparison.name;
  value["verdict"] = verdictName(comparison.verdict);
  value["metric"] = metricName(rule.metric);
  value["threshold"] = rule.threshold;
  value["message"] = comparison.message;
  const bool measured = isMeasured(comparison);
  value["value"] = measured ? metricValue(rule.metric, comparison.difference) : Json::Value();
  value["different_share"] = measured ? comparison.difference.share : Json::Value();
  value["box"] = measured ? boxJson(comparison.difference.box) : Json::Value();
  return value;
}

std::string listText(const std::vector<Json::Value>& values, int digits) {
  std::vector<std::string> lines;
  for (const Json::Value& value : values) lines.push_back(compactText(value, digits));
  return fmt::format("[\n{}\n]\n", fmt::join(lines, ",\n"));
}

std::string comparisonsText(const std::vector<Comparison>& comparisons, const PictureRule& rule) {
  std::vector<Json::Value> values;
  for (const Comparison& comparison : comparisons) values.push_back(comparisonJson(comparison, rule));
  return listText(values);
}

}  // namespace burnish
