#include "cli/completion/key_candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>

#include "engine/core/error.h"
#include "engine/schema/diagnostics.h"
#include "engine/schema/yaml_tree.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

using ValueKind = ValueType::Kind;

/// Declared keys of one level with what stands there in the document.
struct Level {
  std::vector<const Declaration*> keys;
  const YamlNode* node = nullptr;
};

/// The keys of a mapping, and of its alternatives: that which the document has chosen, or all.
void addKeys(const Declarations& keys, const YamlNode* node, std::vector<const Declaration*>& out) {
  for (const Declaration& key : keys) {
    const bool isThere =
        std::ranges::any_of(out, [&](const Declaration* other) { return other->key == key.key; });
    if (!isThere) out.push_back(&key);
    const YamlNode* chosen = node == nullptr ? nullptr : node->find(key.key);
    for (const DeclaredAlternative& alternative : key.alternatives)
      if (chosen == nullptr || chosen->text == alternative.about.name) addKeys(alternative.keys, node, out);
  }
}

/// The level below a key; step: an index behind the key, or nothing.
Level below(const Level& level, const std::string& name, std::optional<std::size_t> index) {
  Level next;
  for (const Declaration* key : level.keys) {
    if (key->key != name) continue;
    const YamlNode* node = level.node == nullptr ? nullptr : level.node->find(name);
    if (node != nullptr && index && node->kind == YamlNode::Kind::Sequence)
      node = *index < node->children.size() ? &node->children[*index] : nullptr;
    addKeys(key->below, node, next.keys);
    next.node = node;
  }
  return next;
}

/// Entries of a list that the document has; one where it does not say.
std::size_t entriesOf(const Level& level, const Declaration& key) {
  const YamlNode* node = level.node == nullptr ? nullptr : level.node->find(key.key);
  return node != nullptr && node->kind == YamlNode::Kind::Sequence ? node->children.size() : 1;
}

void addCandidates(const Level& level, const Declaration& key, const std::string& parent, KeyUse use,
                   std::vector<Candidate>& out) {
  const std::string path = parent + key.key;
  if (use == KeyUse::Explained) {
    out.push_back({path, key.sentence});
    if (!key.below.empty()) out.push_back({path + ".", ""});
    return;
  }
  out.push_back({path + "=", key.sentence});
  if (key.below.empty()) return;
  if (key.type.lists == 0) {
    out.push_back({path + ".", ""});
    return;
  }
  for (std::size_t k = 0; k < entriesOf(level, key); ++k)
    out.push_back({fmt::format("{}[{}].", path, k), ""});
}

std::vector<std::string> valuesOf(const Declaration& key) {
  if (key.type.kind == ValueKind::Truth) return {"true", "false"};
  if (key.type.lists > 0) return {};
  return key.rule.choices;
}

std::optional<YamlNode> treeOf(const std::filesystem::path& document) {
  if (document.empty()) return std::nullopt;
  try {
    Diagnostics errors("", {});
    return parseYaml(readText(document), 0, errors);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<Candidate> keyCandidates(const Declarations& keys, const std::string& path, KeyUse use,
                                     const std::filesystem::path& document) {
  const std::optional<YamlNode> tree = treeOf(document);
  Level level;
  level.node = tree ? &*tree : nullptr;
  addKeys(keys, level.node, level.keys);
  const std::size_t equals = use == KeyUse::Set ? path.find('=') : std::string::npos;
  const std::string written = path.substr(0, equals);
  const std::size_t point = written.rfind('.');
  const std::string parent = point == std::string::npos ? "" : written.substr(0, point + 1);
  const std::vector<PathStep> steps = parsePath(parent.substr(0, parent.empty() ? 0 : parent.size() - 1));
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const auto* name = std::get_if<std::string>(&steps[k]);
    if (name == nullptr) continue;
    std::optional<std::size_t> index;
    if (k + 1 < steps.size())
      if (const auto* next = std::get_if<std::size_t>(&steps[k + 1])) index = *next;
    level = below(level, *name, index);
  }
  std::vector<Candidate> out;
  for (const Declaration* key : level.keys) {
    if (equals == std::string::npos) {
      addCandidates(level, *key, parent, use, out);
    } else if (parent + key->key == written) {
      for (const std::string& value : valuesOf(*key)) out.push_back({written + "=" + value, ""});
    }
  }
  return out;
}

}  // namespace burnish
