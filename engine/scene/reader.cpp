#include "engine/scene/reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/scene/check.h"
#include "engine/scene/mapping_reader.h"
#include "engine/scene/overrides.h"
#include "engine/scene/schema.h"
#include "engine/scene/writer.h"
#include "engine/scene/yaml_document.h"

namespace burnish {
namespace {

const DocumentKind kSceneKind{.name = "scene", .keys = "geometry, material and steps"};

/// The scene's tree with all overrides applied; what is wrong so far is in `errors`.
YamlNode readTree(const std::string& yaml, const std::vector<std::string>& overrides, Diagnostics& errors) {
  YamlNode root = parseDocument(yaml, kSceneKind, errors);
  for (std::size_t i = 0; i < overrides.size(); ++i)
    applyOverride(root, overrides[i], static_cast<int>(i) + 1, errors);
  return root;
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
  return parseScene(readDocument(file, kSceneKind), file.string(), overrides);
}

}  // namespace burnish
