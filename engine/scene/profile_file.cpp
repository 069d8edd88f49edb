#include "engine/scene/profile_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/measured_table.h"
#include "engine/core/quoted.h"
#include "engine/core/unit_label.h"
#include "engine/scene/body_shapes.h"

namespace burnish::inline scene {
namespace {

/// The unit in brackets behind the name of a column, "x [mm]"; empty without one.
std::string unitOf(const std::string& column) {
  const std::size_t begin = column.rfind('['), end = column.rfind(']');
  if (begin == std::string::npos || end != column.size() - 1) return {};
  return column.substr(begin + 1, end - begin - 1);
}

/// What lengths of a column are multiplied by. label: the scene's unit of lengths, or empty. Throws `Error`.
double factorOf(const MeasuredTable& table, std::size_t column, const std::string& label) {
  const std::string unit = unitOf(table.columns()[column]);
  if (unit.empty() || unit == label) return 1.0;
  const auto from = lengthUnitOf(unit), to = lengthUnitOf(label);
  if (from && to) return millimetresOf(*from) / millimetresOf(*to);
  throw Error(
      fmt::format("{}: its lengths are in {}, those of the scene in {}; allowed: one unit, or two of {}",
                  table.path().string(), shortened(unit),
                  label.empty() ? "no unit (units)" : shortened(label), kLengthLabels));
}

/// A sequence of numbers; they are where the name of their file is.
YamlNode sequenceOf(const MeasuredTable& table, std::size_t column, const std::string& label,
                    const YamlNode& file) {
  const double factor = factorOf(table, column, label);
  YamlNode sequence{.kind = YamlNode::Kind::Sequence, .place = file.place, .keyPlace = file.keyPlace};
  for (std::size_t row = 0; row < table.numRows(); ++row)
    sequence.children.push_back({.kind = YamlNode::Kind::Scalar,
                                 .place = file.place,
                                 .text = fmt::format("{}", factor * table.number(row, column))});
  return sequence;
}

void complete(YamlNode& relief, const std::string& path, const std::filesystem::path& directory,
              const std::string& label, Diagnostics& errors) {
  const YamlNode* named = relief.find("file");
  if (named == nullptr) return;
  const YamlNode file = *named;
  for (const char* key : {"places", "heights"})
    if (const YamlNode* other = relief.find(key))
      return errors.add(
          other->keyPlace, fmt::format("{}.{}", path, key),
          fmt::format("found {} beside file; allowed: the profile either here or in the file.", key));
  std::erase_if(relief.children, [](const YamlNode& child) { return child.key == "file"; });
  try {
    const MeasuredTable table(directory / file.text);
    if (table.columns().size() != 2)
      throw Error(fmt::format("{}: holds {} columns; allowed: two, places along the profile and heights",
                              table.path().string(), table.columns().size()));
    for (std::size_t column = 0; column < 2; ++column) {
      YamlNode sequence = sequenceOf(table, column, label, file);
      sequence.key = column == 0 ? "places" : "heights";
      relief.children.push_back(std::move(sequence));
    }
  } catch (const Error& problem) {
    errors.add(file.place, path + ".file", fmt::format("{}.", problem.what()));
  }
}

}  // namespace

void insertProfileFiles(YamlNode& root, const std::filesystem::path& directory, Diagnostics& errors) {
  std::string label;
  if (const YamlNode* units = root.find("units"))
    if (const YamlNode* length = units->find("length")) label = length->text;
  forEachBodyShape(root, [&](YamlNode& shape, const std::string& path) {
    YamlNode* reliefs = shape.find("relief");
    if (reliefs == nullptr || reliefs->kind != YamlNode::Kind::Sequence) return;
    for (std::size_t k = 0; k < reliefs->children.size(); ++k)
      complete(reliefs->children[k], fmt::format("{}.relief[{}]", path, k), directory, label, errors);
  });
}

}  // namespace burnish::inline scene
