#include "engine/scene/scene_reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/scene/check.h"
#include "engine/scene/check_context.h"
#include "engine/scene/control_net_file.h"
#include "engine/scene/end_of_run.h"
#include "engine/scene/path_mesh.h"
#include "engine/scene/profile_file.h"
#include "engine/scene/scene_places.h"
#include "engine/scene/tool_files.h"
#include "engine/schema/overrides.h"

namespace burnish::inline scene {
namespace {

/// The scene's tree with all overrides applied and the files of control nets and profiles put in, those of tools found;
/// what is wrong so far is in `errors`.
YamlNode readTree(const std::string& yaml, const std::string& name, const std::vector<std::string>& overrides,
                  Diagnostics& errors) {
  YamlNode root = parseDocument(yaml, kSceneKind, errors);
  for (std::size_t i = 0; i < overrides.size(); ++i)
    applyOverride(root, overrides[i], static_cast<int>(i) + 1, errors);
  const std::filesystem::path directory = std::filesystem::path(name).parent_path();
  insertControlNetFiles(root, directory, errors);
  insertProfileFiles(root, directory, errors);
  resolveToolFiles(root, directory, errors);
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
    if (const auto* net = std::get_if<ControlNetBody>(&shape))
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
void takeDegreeOfNets(BodySpec& body) {
  const auto degrees = netDegrees(body.geometry);
  if (degrees.empty()) return;
  const auto [lowest, highest] = std::minmax_element(degrees.begin(), degrees.end());
  body.degree = body.basis == BasisChoice::Nurbs ? *lowest : *highest;
}

/// What follows for a body from what the scene says of all. keys: of the body in the scene's tree.
void takeDefaults(BodySpec& body, const BodySpec& common, const YamlNode& keys, const YamlNode& root) {
  if (keys.find("basis") == nullptr) body.basis = common.basis;
  if (keys.find("formulation") == nullptr) body.formulation = common.formulation;
  if (!body.quadraturePoints) body.quadraturePoints = common.quadraturePoints;
  if (keys.find("degree") != nullptr) return;
  body.degree = common.degree;
  if (root.find("degree") == nullptr) takeDegreeOfNets(body);
}

void takeDefaults(Scene& scene, const YamlNode& root) {
  if (const YamlNode* list = root.find("bodies"); list != nullptr)
    for (std::size_t k = 0; k < scene.bodies.size(); ++k)
      takeDefaults(scene.bodies[k], scene.body, list->children[k], root);
  else if (root.find("degree") == nullptr)
    takeDegreeOfNets(scene.body);
  resolveMeshes(scene);
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

SceneReading::SceneReading(const std::string& yaml, std::string name,
                           const std::vector<std::string>& overrides)
    : name_(std::move(name)), errors_(name_, overrides), root_(readTree(yaml, name_, overrides, errors_)) {}

void SceneReading::check(Scene& scene) {
  takeDefaults(scene, root_);
  if (const CheckContext context{scene, root_, errors_}; context.dimensionIsKnown()) {
    checkPatchDimensions(context);
    checkDimensions(dimensioned_, scene.dim(), errors_);
  }
  checkScene(scene, root_, errors_);
}

void SceneReading::finish(Scene& scene, std::string resolvedYaml) {
  errors_.throwIfAny();
  scene.source = name_;
  scene.resolvedYaml = std::move(resolvedYaml);
  scene.places = std::make_shared<const ScenePlaces>(ScenePlaces{std::move(root_), errors_});
}

}  // namespace burnish::inline scene
