#include "engine/scene/control_net_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "engine/scene/tool_files.h"
#include "engine/schema/yaml_document.h"
#include "engine/tools/tool_shape.h"

namespace burnish {
namespace {

const DocumentKind kNetKind{.name = "control net", .keys = "degrees, knots and points"};
const std::vector<std::string> kKeys{"degrees", "knots", "points", "weights"};
constexpr std::array<const char*, 3> kRequired{"degrees", "knots", "points"};

bool isKey(const YamlNode& node) {
  return std::find(kKeys.begin(), kKeys.end(), node.key) != kKeys.end();
}

/// Like `YamlNode::find`, to be changed.
YamlNode* child(YamlNode& node, const std::string& key) {
  const auto it = std::find_if(node.children.begin(), node.children.end(),
                               [&](const YamlNode& c) { return c.key == key; });
  return it == node.children.end() ? nullptr : &*it;
}

void requireKeys(const YamlNode& holder, const std::string& path, const char* remedy, Diagnostics& errors) {
  for (const char* key : kRequired)
    if (holder.find(key) == nullptr)
      errors.add(holder.place, fmt::format("{}.{}", path, key),
                 fmt::format("missing; required: degrees, knots and points{}.", remedy));
}

/// The mapping in a file; without a value its problem is reported, at `place` if it cannot be read.
std::optional<YamlNode> readNet(const std::filesystem::path& file, const Place& place,
                                const std::string& path, Diagnostics& errors) {
  std::string text;
  try {
    text = readDocument(file, kNetKind);
  } catch (const Error& problem) {
    errors.add(place, path + ".file", fmt::format("{}.", problem.what()));
    return std::nullopt;
  }
  auto net = parseYaml(text, errors.addFile(file.string()), errors, path);
  if (net && net->kind != YamlNode::Kind::Mapping) {
    errors.add(
        net->place, path,
        fmt::format("found {}; allowed: a mapping of degrees, knots, points and weights.", net->describe()));
    return std::nullopt;
  }
  return net;
}

/// The keys of a file take the place of its name.
void insertFile(YamlNode& shape, const std::string& path, const std::filesystem::path& directory,
                Diagnostics& errors) {
  const YamlNode name = *shape.find("file");
  for (const YamlNode& other : shape.children)
    if (isKey(other))
      return errors.add(
          other.keyPlace, fmt::format("{}.{}", path, other.key),
          fmt::format("found {} beside file; allowed: all of the control net either here or in the file.",
                      other.key));
  auto net = readNet(directory / name.text, name.place, path, errors);
  std::erase_if(shape.children, [](const YamlNode& c) { return c.key == "file"; });
  if (!net) return;
  for (const YamlNode& found : net->children)
    if (!isKey(found))
      errors.add(found.keyPlace, fmt::format("{}.{}", path, found.key),
                 fmt::format("found an unknown key; allowed: {}.{}", fmt::join(kKeys, ", "),
                             didYouMean(found.key, kKeys)));
  requireKeys(*net, path, "", errors);
  std::erase_if(net->children, [](const YamlNode& c) { return !isKey(c); });
  std::move(net->children.begin(), net->children.end(), std::back_inserter(shape.children));
}

bool isNetOfBody(const std::string& shape) {
  return shape == "control-net";
}
bool isNetOfTool(const std::string& shape) {
  return fileOf(shape) == ShapeFile::ControlNet;
}

/// A shape that may be a control net, at a path.
void complete(YamlNode& shape, const std::string& path, const std::filesystem::path& directory,
              Diagnostics& errors, bool (*isNet)(const std::string&) = isNetOfBody) {
  const YamlNode* kind = shape.find("shape");
  if (kind == nullptr || !isNet(kind->text)) return;
  const YamlNode* file = shape.find("file");
  if (file == nullptr || (file->kind == YamlNode::Kind::Scalar && file->text.empty()))
    requireKeys(shape, path, ", or a file that holds them", errors);
  else if (file->kind == YamlNode::Kind::Scalar)
    insertFile(shape, path, directory, errors);
}

/// The geometry of a body whose keys begin with `prefix`.
void completeGeometry(YamlNode& body, const std::string& prefix, const std::filesystem::path& directory,
                      Diagnostics& errors) {
  YamlNode* geometry = child(body, "geometry");
  if (geometry == nullptr) return;
  complete(*geometry, prefix + "geometry", directory, errors);
  YamlNode* patches = child(*geometry, "patches");
  if (patches == nullptr || patches->kind != YamlNode::Kind::Sequence) return;
  for (std::size_t i = 0; i < patches->children.size(); ++i)
    complete(patches->children[i], fmt::format("{}geometry.patches[{}]", prefix, i), directory, errors);
}

}  // namespace

void insertControlNetFiles(YamlNode& root, const std::filesystem::path& directory, Diagnostics& errors) {
  forEachToolShape(root, [&](YamlNode& tool, const std::string& path) {
    complete(tool, path, directory, errors, isNetOfTool);
  });
  completeGeometry(root, "", directory, errors);
  YamlNode* bodies = child(root, "bodies");
  if (bodies == nullptr || bodies->kind != YamlNode::Kind::Sequence) return;
  for (std::size_t k = 0; k < bodies->children.size(); ++k)
    completeGeometry(bodies->children[k], fmt::format("bodies[{}].", k), directory, errors);
}

}  // namespace burnish
