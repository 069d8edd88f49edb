#include "engine/scene/control_net_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/cad/cad_file.h"
#include "engine/core/error.h"
#include "engine/core/lower_case.h"
#include "engine/core/nearest.h"
#include "engine/core/quoted.h"
#include "engine/scene/body_shapes.h"
#include "engine/scene/cad_net.h"
#include "engine/scene/net_formats.h"
#include "engine/scene/tool_files.h"
#include "engine/schema/yaml_document.h"
#include "engine/solid/bodies/bodies.h"
#include "engine/tools/tool_shape.h"

namespace burnish::inline scene {
namespace {

const DocumentKind kNetKind{
    .name = "control net", .keys = "degrees, knots and points", .format = "YAML, g2, JSON, STEP or IGES"};
const std::vector<std::string> kKeys{"degrees", "knots", "points", "weights"};

/// Those that say what is taken from a CAD file, and how; they go with its name.
constexpr std::array<std::string_view, 3> kCadKeys{"face", "unit", "flip"};

/// What a net is for, which says what it must have.
enum class NetOf { Body, Tool, Profile };

/// The scene that names files.
struct NamingScene {
  const YamlNode& root;
  std::filesystem::path directory;
};

bool isKey(const YamlNode& node) {
  return std::find(kKeys.begin(), kKeys.end(), node.key) != kKeys.end();
}

void requireKeys(const YamlNode& holder, const std::string& path, NetOf what, const char* remedy,
                 Diagnostics& errors) {
  const bool isProfile = what == NetOf::Profile;
  for (const char* key : {"degrees", "knots", "points"})
    if (holder.find(key) == nullptr && !(isProfile && std::string(key) == "knots"))
      errors.add(holder.place, fmt::format("{}.{}", path, key),
                 fmt::format("missing; required: {}{}.",
                             isProfile ? "degrees and points" : "degrees, knots and points", remedy));
}

/// The net that a scene's `entry` chooses.
std::optional<YamlNode> chosen(std::vector<YamlNode> nets, const YamlNode* entry, const Place& place,
                               const std::string& path, Diagnostics& errors) {
  if (entry == nullptr) {
    if (nets.size() == 1) return std::move(nets.front());
    errors.add(
        place, path + ".file",
        fmt::format("found a file of {} objects; allowed: one, or entry: 0 to {} beside file, which chooses.",
                    nets.size(), nets.size() - 1));
    return std::nullopt;
  }
  std::size_t number = nets.size();
  std::from_chars(entry->text.data(), entry->text.data() + entry->text.size(), number);
  if (number < nets.size()) return std::move(nets[number]);
  errors.add(
      entry->place, path + ".entry",
      fmt::format("found {}; allowed: a whole number from 0 to {}, for the {} of the file.",
                  entry->kind == YamlNode::Kind::Scalar ? shortened(entry->text) : entry->describe(),
                  nets.size() - 1, nets.size() == 1 ? "one object" : fmt::format("{} objects", nets.size())));
  return std::nullopt;
}

/// The mapping in a file; without a value its problem is reported, at `place` if it cannot be read. entry: which of
/// several, or null.
std::optional<YamlNode> readNet(const std::filesystem::path& file, const YamlNode* entry, const Place& place,
                                const std::string& path, Diagnostics& errors) {
  std::string text;
  try {
    text = readDocument(file, kNetKind);
  } catch (const Error& problem) {
    errors.add(place, path + ".file", fmt::format("{}.", problem.what()));
    return std::nullopt;
  }
  const int source = errors.addFile(file.string());
  if (inLowerCase(file.extension().string()) == ".g2") {
    auto nets = netsOfG2(text, source, path, errors);
    return nets ? chosen(std::move(*nets), entry, place, path, errors) : std::nullopt;
  }
  if (inLowerCase(file.extension().string()) == ".json" && !isJson(text, source, path, errors))
    return std::nullopt;
  auto net = parseYaml(text, source, errors, path);
  if (!net) return std::nullopt;
  if (net->kind == YamlNode::Kind::Mapping && net->find("shape") != nullptr) {
    auto nets = netsOfJson(*net, path, errors);
    return nets ? chosen(std::move(*nets), entry, place, path, errors) : std::nullopt;
  }
  if (net->kind != YamlNode::Kind::Mapping) {
    errors.add(
        net->place, path,
        fmt::format("found {}; allowed: a mapping of degrees, knots, points and weights.", net->describe()));
    return std::nullopt;
  }
  std::vector<YamlNode> one;
  one.push_back(std::move(*net));
  return chosen(std::move(one), entry, place, path, errors);
}

/// Points of the plane z = 0 lose their third coordinate where a net of two dimensions is meant: other programs
/// write it always.
void flatten(YamlNode& net, NetOf what) {
  const YamlNode* degrees = net.find("degrees");
  YamlNode* points = net.find("points");
  if (degrees == nullptr || points == nullptr) return;
  if (degrees->children.size() != (what == NetOf::Tool ? 1 : 2) && what != NetOf::Profile) return;
  const auto isFlat = [](const YamlNode& point) {
    double z = 1.0;
    if (point.children.size() != 3) return false;
    const std::string& text = point.children[2].text;
    std::from_chars(text.data(), text.data() + text.size(), z);
    return z == 0.0;
  };
  if (!std::ranges::all_of(points->children, isFlat)) return;
  for (YamlNode& point : points->children) point.children.pop_back();
}

/// The keys of a file take the place of its name.
void insertFile(YamlNode& shape, const std::string& path, NetOf what, const NamingScene& scene,
                Diagnostics& errors) {
  const YamlNode name = *shape.find("file");
  for (const YamlNode& other : shape.children)
    if (isKey(other))
      return errors.add(
          other.keyPlace, fmt::format("{}.{}", path, other.key),
          fmt::format("found {} beside file; allowed: all of the control net either here or in the file.",
                      other.key));
  const std::filesystem::path file = scene.directory / name.text;
  const bool isCad = isCadFile(file);
  const bool takesFaces = what != NetOf::Tool;
  for (const std::string_view key : kCadKeys)
    if (const YamlNode* other = shape.find(std::string(key)); other != nullptr && !isCad && takesFaces)
      errors.add(
          other->keyPlace, fmt::format("{}.{}", path, key),
          fmt::format("found {} beside {}; allowed: with a file that ends in .step, .stp, .iges or .igs.",
                      key, shortened(name.text)));
  if (isCad && !takesFaces)
    errors.add(name.place, path + ".file",
               "found a CAD file; allowed: shape: cad, for a tool that is a part of it.");
  std::optional<YamlNode> net;
  if (!isCad)
    net = readNet(file, shape.find("entry"), name.place, path, errors);
  else if (takesFaces)
    net = netOfCad(file, shape, scene.root, path, what == NetOf::Body, errors);
  std::erase_if(shape.children, [takesFaces](const YamlNode& c) {
    return c.key == "file" || c.key == "entry" || (takesFaces && std::ranges::count(kCadKeys, c.key) > 0);
  });
  if (!net) return;
  for (const YamlNode& found : net->children)
    if (!isKey(found))
      errors.add(found.keyPlace, fmt::format("{}.{}", path, found.key),
                 fmt::format("found an unknown key; allowed: {}.{}", fmt::join(kKeys, ", "),
                             didYouMean(found.key, kKeys)));
  requireKeys(*net, path, what, "", errors);
  std::erase_if(net->children, [](const YamlNode& c) { return !isKey(c); });
  flatten(*net, what);
  std::move(net->children.begin(), net->children.end(), std::back_inserter(shape.children));
}

/// A control net at a path.
void complete(YamlNode& net, const std::string& path, NetOf what, const NamingScene& scene,
              Diagnostics& errors) {
  const YamlNode* file = net.find("file");
  if (file == nullptr || (file->kind == YamlNode::Kind::Scalar && file->text.empty())) {
    if (const YamlNode* entry = net.find("entry"))
      errors.add(entry->keyPlace, path + ".entry",
                 "found without file; allowed: beside the file of which it is one.");
    for (const std::string_view key : kCadKeys)
      if (const YamlNode* other = net.find(std::string(key)); other != nullptr && what != NetOf::Tool)
        errors.add(other->keyPlace, fmt::format("{}.{}", path, key),
                   "found without file; allowed: beside a CAD file.");
    requireKeys(net, path, what, ", or a file that holds them", errors);
  } else if (file->kind == YamlNode::Kind::Scalar) {
    insertFile(net, path, what, scene, errors);
  }
}

/// Adds the keys of the curves and faces that a shape is made from if it has this name.
template <class Shape>
void addNetsOf(const std::string& name, std::vector<std::string>& keys) {
  if constexpr (requires { Shape::nets; })
    if (name == Shape::kind.key) keys.assign(Shape::nets.begin(), Shape::nets.end());
}

/// The same of the shape of bodies with this name.
template <class... Shape>
std::vector<std::string> netsOf(const std::string& name, const std::variant<Shape...>& /*all*/) {
  std::vector<std::string> keys;
  (addNetsOf<Shape>(name, keys), ...);
  return keys;
}

/// The shape of a body or of one of its patches.
void completeShape(YamlNode& shape, const std::string& path, const NamingScene& scene, Diagnostics& errors) {
  const YamlNode* kind = shape.find("shape");
  if (kind == nullptr) return;
  const std::string name = kind->text;  // the keys of a file move what the mapping has
  if (name == ControlNetBody::kind.key) complete(shape, path, NetOf::Body, scene, errors);
  for (const std::string& key : netsOf(name, BodyShape()))
    if (YamlNode* net = shape.find(key); net != nullptr && net->kind == YamlNode::Kind::Mapping)
      complete(*net, fmt::format("{}.{}", path, key), NetOf::Profile, scene, errors);
}

}  // namespace

void insertControlNetFiles(YamlNode& root, const std::filesystem::path& directory, Diagnostics& errors) {
  const NamingScene scene{root, directory};
  forEachToolShape(root, [&](YamlNode& tool, const std::string& path) {
    if (const YamlNode* kind = tool.find("shape");
        kind != nullptr && fileOf(kind->text) == ShapeFile::ControlNet)
      complete(tool, path, NetOf::Tool, scene, errors);
  });
  forEachBodyShape(
      root, [&](YamlNode& shape, const std::string& path) { completeShape(shape, path, scene, errors); });
}

}  // namespace burnish::inline scene
