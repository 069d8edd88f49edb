#include "cli/commands/info_json.h"

#include <charconv>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "engine/core/error.h"
#include "engine/results/history.h"
#include "engine/results/summary_file.h"
#include "postproc/draw/foreign/foreign_fields.h"
#include "postproc/draw/foreign/foreign_ranges.h"
#include "postproc/mesh/recorded_shape.h"
#include "postproc/text/described_json.h"

namespace burnish {
namespace {

template <class Values>
Json::Value listOf(const Values& values) {
  Json::Value list(Json::arrayValue);
  for (const auto& value : values) list.append(value);
  return list;
}

Json::Value fieldJson(const std::string& name, const std::vector<std::string>& components,
                      const std::string& unit) {
  Json::Value field;
  field["name"] = name;
  field["components"] = listOf(components);
  field["unit"] = unit;
  return field;
}

/// Of a scalar and of the length of a vector one, of others one for each component.
Json::Value rangesJson(const ForeignField& field, const ForeignRanges& ranges) {
  Json::Value list(Json::arrayValue);
  const auto add = [&](int component) {
    const ForeignRange range = ranges.of({field, component});
    Json::Value& added = list.append(Json::Value());
    added["component"] =
        component < 0 ? Json::Value() : Json::Value(field.components[static_cast<std::size_t>(component)]);
    added["min"] = range.values ? Json::Value((*range.values)[0]) : Json::Value();
    added["max"] = range.values ? Json::Value((*range.values)[1]) : Json::Value();
    added["not_finite"] = static_cast<Json::Int64>(range.gaps);
  };
  if (field.components.empty() || field.isVector()) {
    add(-1);
    return list;
  }
  for (std::size_t k = 0; k < field.components.size(); ++k) add(static_cast<int>(k));
  return list;
}

Json::Value scalarJson(const YamlNode& node) {
  if (node.quoted) return node.text;
  if (node.text == "true" || node.text == "false") return node.text == "true";
  const char* end = node.text.data() + node.text.size();
  long whole = 0;
  if (const auto [rest, problem] = std::from_chars(node.text.data(), end, whole);
      problem == std::errc() && rest == end)
    return static_cast<Json::Int64>(whole);
  double number = 0.0;
  if (const auto [rest, problem] = std::from_chars(node.text.data(), end, number);
      problem == std::errc() && rest == end)
    return number;
  return node.text;
}

}  // namespace

Json::Value resultJson(const ResultReader& result) {
  const ModelRecord& model = result.model();
  Json::Value value;
  value["result"] = result.file().string();
  value["title"] = model.title;
  value["program"] = model.program;
  value["dimensions"] = model.dim;
  value["nodes"] = static_cast<Json::Int64>(model.mesh.numNodes);
  value["bodies"] = listOf(model.bodies);
  value["tools"] = Json::Value(Json::arrayValue);
  for (const ToolRecord& tool : model.tools) {
    Json::Value& added = value["tools"].append(Json::Value());
    added["name"] = tool.name;
    added["shape"] = shapeText(tool.shape);
    if (tool.until) added["until"] = *tool.until;
  }
  value["times"] = listOf(result.times());
  value["fields"] = Json::Value(Json::arrayValue);
  if (result.numFrames() > 0)
    for (const auto& [name, field] : result.frame(result.numFrames() - 1).fields)
      value["fields"].append(fieldJson(name, field.components, field.unit));
  const std::filesystem::path directory = result.file().parent_path();
  std::error_code status;
  if (std::filesystem::exists(directory / "history.csv", status)) {
    const HistoryTable history = readHistory(directory / "history.csv");
    value["rows"] = static_cast<Json::UInt64>(history.numRows());
    value["columns"] = listOf(history.columns);
  }
  if (std::filesystem::exists(directory / "summary.yaml", status))
    value["summary"] = describedJson(readSummary(directory));
  return value;
}

Json::Value foreignJson(const ForeignFile& file) {
  const std::vector<double>& times = file.times();
  const std::vector<ForeignBlock> blocks = file.blocks(times.empty() ? 0 : times.size() - 1);
  Json::Value value;
  value["file"] = file.file().string();
  value["kind"] = foreignKind(file.file());
  value["times"] = listOf(times);
  value["frame"] = times.empty() ? Json::Value() : Json::Value(static_cast<Json::UInt64>(times.size() - 1));
  value["blocks"] = Json::Value(Json::arrayValue);
  for (const ForeignBlock& block : blocks) {
    Json::Value& added = value["blocks"].append(Json::Value());
    added["name"] = block.name;
    added["points"] = static_cast<Json::Int64>(block.grid->GetNumberOfPoints());
    added["cells"] = static_cast<Json::Int64>(block.grid->GetNumberOfCells());
  }
  value["fields"] = Json::Value(Json::arrayValue);
  const ForeignRanges ranges(blocks);
  for (const ForeignField& field : foreignFieldsOf(blocks)) {
    Json::Value& added = value["fields"].append(fieldJson(field.name, field.components, field.unit));
    added["of"] = field.ofCells ? "cells" : "points";
    added["ranges"] = rangesJson(field, ranges);
  }
  return value;
}

Json::Value documentJson(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::Scalar) return scalarJson(node);
  if (node.kind == YamlNode::Kind::Null) return {};
  Json::Value value(node.kind == YamlNode::Kind::Sequence ? Json::arrayValue : Json::objectValue);
  for (const YamlNode& child : node.children)
    if (node.kind == YamlNode::Kind::Sequence)
      value.append(documentJson(child));
    else
      value[child.key] = documentJson(child);
  return value;
}

}  // namespace burnish
