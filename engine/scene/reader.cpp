#include "engine/scene/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/scene/check.h"
#include "engine/scene/check_context.h"
#include "engine/scene/control_net_file.h"
#include "engine/scene/end_of_run.h"
#include "engine/scene/scene_places.h"
#include "engine/scene/schema.h"
#include "engine/scene/tool_files.h"
#include "engine/scene/writer.h"
#include "engine/schema/mapping_reader.h"
#include "engine/schema/overrides.h"
#include "engine/schema/yaml_document.h"

namespace burnish {
namespace {

const DocumentKind kSceneKind{.name = "scene", .keys = "geometry, material and steps"};

/// The scene's tree with all overrides applied and the files of control nets put in, those of tools found;
/// what is wrong so far is in `errors`.
YamlNode readTree(const std::string& yaml, const std::string& name, const std::vector<std::string>& overrides,
                  Diagnostics& errors) {
  YamlNode root = parseDocument(yaml, kSceneKind, errors);
  for (std::size_t i = 0; i < overrides.size(); ++i)
    applyOverride(root, overrides[i], static_cast<int>(i) + 1, errors);
  const std::filesystem::path directory = std::filesystem::path(name).parent_path();
  insertControlNetFiles(root, directory, errors);
  resolveToolFiles(root, directory);
  if (const YamlNode* steps = root.find("steps"); steps != nullptr && !steps->children.empty())
    if (const YamlNode* until = steps->children.back().find("until"); until != nullptr)
      replaceEndOfRun(root, until->text);
  return root;
}

/// Degrees of the control nets if the body consists of nothing else.
std::vector<int> netDegrees(const GeometrySpec& geometry) {
  std::vector<int> degrees;
  bool only = true;
  const auto add = [&](const auto& shape) {
    if (const auto* net = std::get_if<ControlNetSpec>(&shape))
      degrees.insert(degrees.end(), net->degrees.begin(), net->degrees.end());
    else
      only = false;
  };
  if (const auto* body = std::get_if<PatchesSpec>(&geometry.shape))
    for (const PatchSpec& patch : body->patches) add(patch.shape);
  else
    add(geometry.shape);
  return only ? degrees : std::vector<int>();
}

/// A body of control nets that is given no degree: NURBS as they are, of which none is raised to the lowest
/// degree, Lagrange elements of the highest.
void takeDegree(Scene& scene, const YamlNode& root) {
  const auto degrees = netDegrees(scene.geometry);
  if (root.find("degree") != nullptr || degrees.empty()) return;
  const auto [lowest, highest] = std::minmax_element(degrees.begin(), degrees.end());
  scene.degree = scene.basis == BasisChoice::Nurbs ? *lowest : *highest;
}

void checkDimensions(const std::vector<DimensionedList>& lists, int dim, Diagnostics& errors) {
  for (const DimensionedList& list : lists)
    if (list.entries != static_cast<std::size_t>(dim) && errors.clean(list.path))
      errors.add(
          list.place, list.path,
          fmt::format("found a list of {}; allowed: a list of {}, one entry per dimension of the body.",
                      list.entries, dim));
}

}  // namespace

Scene parseScene(const std::string& yaml, const std::string& name,
                 const std::vector<std::string>& overrides) {
  Diagnostics errors(name, overrides);
  YamlNode root = readTree(yaml, name, overrides, errors);

  Scene scene;
  std::vector<DimensionedList> dimensioned;
  MappingReader(root, "", errors, dimensioned).readInto(scene);
  if (errors.full()) errors.throwIfAny();
  takeDegree(scene, root);
  if (const CheckContext context{scene, root, errors}; context.dimensionIsKnown()) {
    checkPatchDimensions(context);
    checkDimensions(dimensioned, scene.dim(), errors);
  }
  checkScene(scene, root, errors);
  errors.throwIfAny();

  scene.source = name;
  scene.resolvedYaml = writeScene(scene);
  scene.places = std::make_shared<const ScenePlaces>(ScenePlaces{std::move(root), errors});
  return scene;
}

Scene readScene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return parseScene(readDocument(file, kSceneKind), file.string(), overrides);
}

}  // namespace burnish
