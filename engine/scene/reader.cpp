#include "engine/scene/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "engine/core/error.h"
#include "engine/scene/check.h"
#include "engine/scene/mapping_reader.h"
#include "engine/scene/overrides.h"
#include "engine/scene/schema.h"
#include "engine/scene/writer.h"

namespace burnish {
namespace {

std::string readText(const std::filesystem::path& file) {
  constexpr std::size_t largest = 64 * 1024 * 1024;
  const std::string name = file.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw Error(fmt::format("{}: this is a directory; a scene is a YAML file", name));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(fmt::format("{}: cannot be read: {}", name, std::strerror(errno)));
  std::string text;
  std::vector<char> block(64 * 1024);
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) || stream.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > largest)
      throw Error(fmt::format("{}: larger than 64 MB; a scene is a small YAML file", name));
  }
  return text;
}

/// The scene's tree with all overrides applied; everything that is wrong so far is thrown.
YamlNode readTree(const std::string& yaml, const std::vector<std::string>& overrides, Diagnostics& errors) {
  auto root = parseYaml(yaml, 0, errors);
  if (root && root->kind == YamlNode::Kind::Null)
    errors.add(root->place, "", "the file is empty; a scene has at least geometry, material and steps");
  else if (root && root->kind != YamlNode::Kind::Mapping)
    errors.add(root->place, "",
               fmt::format("found {}; a scene is a mapping of keys such as geometry, material and steps",
                           root->describe()));
  if (!root || root->kind != YamlNode::Kind::Mapping) errors.throwIfAny();
  for (std::size_t i = 0; i < overrides.size(); ++i)
    applyOverride(*root, overrides[i], static_cast<int>(i) + 1, errors);
  return *std::move(root);
}

void checkDimensions(const std::vector<DimensionedList>& lists, int dim, Diagnostics& errors) {
  for (const DimensionedList& list : lists)
    if (list.entries != static_cast<std::size_t>(dim))
      errors.add(
          list.place, list.path,
          fmt::format("found a list of {}; allowed: a list of {}, one entry per dimension of the body.",
                      list.entries, dim));
}

}  // namespace

Scene parseScene(const std::string& yaml, const std::string& name,
                 const std::vector<std::string>& overrides) {
  Diagnostics errors(name, overrides);
  const YamlNode root = readTree(yaml, overrides, errors);

  Scene scene;
  std::vector<DimensionedList> dimensioned;
  MappingReader(root, "", errors, dimensioned).readInto(scene);
  if (errors.full()) errors.throwIfAny();
  if (errors.clean("geometry.shape") && errors.clean("geometry.degrees"))
    checkDimensions(dimensioned, scene.dim(), errors);
  checkScene(scene, root, errors);
  errors.throwIfAny();

  if (const auto* net = std::get_if<ControlNetSpec>(&scene.geometry.shape))
    scene.degree = *std::max_element(net->degrees.begin(), net->degrees.end());
  scene.source = name;
  scene.resolvedYaml = writeScene(scene);
  return scene;
}

Scene readScene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return parseScene(readText(file), file.string(), overrides);
}

}  // namespace burnish
