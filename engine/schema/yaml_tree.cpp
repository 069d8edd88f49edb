#include "engine/schema/yaml_tree.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>
#include <utility>

#include "engine/core/quoted.h"
#include "engine/core/shown_text.h"

namespace burnish::inline schema {
namespace {

constexpr int deepestLevel = 50;
constexpr std::size_t mostNodes = 1'000'000;

std::string tooDeep() {
  return fmt::format(
      "nested deeper than {} levels of lists and mappings in one another, the most that are allowed",
      deepestLevel);
}

/// Copies a document of yaml-cpp, whose nodes are shared and may be cyclic, into a bounded tree.
class TreeBuilder {
 public:
  TreeBuilder(int source, Diagnostics& errors) : source_(source), errors_(errors) {}

  YamlNode build(const YAML::Node& from, const Place& parent, const std::string& path, int level) {
    if (level > deepestLevel) throw YAML::ParserException(from.Mark(), tooDeep());
    if (++nodes_ > mostNodes)
      throw YAML::ParserException(from.Mark(), fmt::format("more than {} values", mostNodes));
    YamlNode node;
    node.place = place(from.Mark(), parent);
    if (from.IsScalar()) {
      node.kind = YamlNode::Kind::Scalar;
      node.text = from.Scalar();
      node.quoted = from.Tag() == "!" || from.Tag().ends_with(":str");
      requireText(node.text, node.place, path);
    } else if (from.IsSequence()) {
      node.kind = YamlNode::Kind::Sequence;
      for (const auto& item : from)
        node.children.push_back(
            build(item, node.place, fmt::format("{}[{}]", path, node.children.size()), level + 1));
    } else if (from.IsMap()) {
      buildMapping(from, node, path, level);
    }
    return node;
  }

  /// Whether a text is none, so that not even a message should repeat it.
  bool isBroken() const { return broken_; }

 private:
  bool requireText(const std::string& text, const Place& place, const std::string& path) {
    const std::string fault = encodingFault(text);
    if (fault.empty()) return true;
    errors_.add(place, path, fault + ".");
    broken_ = true;
    return false;
  }

  Place place(const YAML::Mark& mark, const Place& parent) const {
    return mark.is_null() ? parent : Place{source_, mark.line + 1, mark.column + 1};
  }

  void buildMapping(const YAML::Node& from, YamlNode& node, const std::string& path, int level) {
    node.kind = YamlNode::Kind::Mapping;
    std::map<std::string, Place> seen;
    for (const auto& entry : from) {
      const Place keyPlace = place(entry.first.Mark(), node.place);
      if (!entry.first.IsScalar()) {
        errors_.add(keyPlace, path, "a key must be a plain word, not a list, a mapping or nothing");
        continue;
      }
      const std::string& key = entry.first.Scalar();
      if (!requireText(key, keyPlace, path)) continue;
      const std::string keyPath = path.empty() ? key : path + "." + key;
      const auto [first, fresh] = seen.try_emplace(key, keyPlace);
      if (!fresh) {
        errors_.add(
            keyPlace, keyPath,
            fmt::format("the key is already given in line {}; keep one of the two", first->second.line));
        continue;
      }
      YamlNode value = build(entry.second, keyPlace, keyPath, level + 1);
      value.key = key;
      value.keyPlace = keyPlace;
      node.children.push_back(std::move(value));
    }
  }

  int source_;
  Diagnostics& errors_;
  std::size_t nodes_ = 0;
  bool broken_ = false;
};

/// Watches the parser go by and keeps where documents begin.
class DocumentStarts : public YAML::EventHandler {
 public:
  const std::vector<YAML::Mark>& marks() const { return marks_; }

  void OnDocumentStart(const YAML::Mark& mark) override { marks_.push_back(mark); }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
  }
  void OnMapEnd() override {}

 private:
  std::vector<YAML::Mark> marks_;
};

/// Where a second document begins. The parser takes stray text for an endless row of empty documents, so it
/// is asked for two and no more.
std::optional<YAML::Mark> secondDocument(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentStarts starts;
  if (!parser.HandleNextDocument(starts) || !parser.HandleNextDocument(starts)) return std::nullopt;
  return starts.marks().back();
}

const YamlNode* step(const YamlNode& node, const PathStep& where) {
  if (const auto* key = std::get_if<std::string>(&where)) return node.find(*key);
  const std::size_t index = std::get<std::size_t>(where);
  return node.kind == YamlNode::Kind::Sequence && index < node.children.size() ? &node.children[index]
                                                                               : nullptr;
}

}  // namespace

const YamlNode* YamlNode::find(const std::string& name) const {
  if (kind != Kind::Mapping) return nullptr;
  const auto it =
      std::find_if(children.begin(), children.end(), [&](const YamlNode& c) { return c.key == name; });
  return it == children.end() ? nullptr : &*it;
}

YamlNode* YamlNode::find(const std::string& name) {
  return const_cast<YamlNode*>(std::as_const(*this).find(name));
}

std::string YamlNode::describe() const {
  switch (kind) {
    case Kind::Null:
      return "nothing";
    case Kind::Sequence:
      return children.size() == 1 ? "a list of 1 entry"
                                  : fmt::format("a list of {} entries", children.size());
    case Kind::Mapping:
      return "a mapping";
    case Kind::Scalar:
      break;
  }
  return quoted ? fmt::format("the text {}", burnish::quoted(text)) : shortened(text);
}

std::optional<YamlNode> parseYaml(const std::string& text, int source, Diagnostics& errors,
                                  const std::string& path) {
  try {
    const YAML::Node document = YAML::Load(text);
    if (const auto mark = secondDocument(text)) {
      errors.add(Place{source, mark->line + 1, mark->column + 1}, path,
                 "found a second YAML document, or text that belongs to no key; allowed: one document");
      return std::nullopt;
    }
    TreeBuilder builder(source, errors);
    YamlNode root = builder.build(document, {source, 1, 1}, path, 0);
    if (builder.isBroken()) return std::nullopt;
    return root;
  } catch (const YAML::Exception& e) {
    const Place place =
        e.mark.is_null() ? Place{source, 1, 1} : Place{source, e.mark.line + 1, e.mark.column + 1};
    // The parser has this text for nesting that it does not follow; there is no file that could be bad.
    if (e.msg == YAML::ErrorMsg::BAD_FILE || e.msg == tooDeep()) {
      errors.add(place, path, tooDeep());
      return std::nullopt;
    }
    errors.add(
        place, path,
        fmt::format("malformed YAML: {}; look at brackets, quotes and indentation here and just before",
                    e.msg));
    return std::nullopt;
  }
}

std::vector<PathStep> parsePath(const std::string& text) {
  std::vector<PathStep> path;
  std::size_t at = 0;
  while (at < text.size()) {
    if (text[at] == '[') {
      const std::size_t end = text.find(']', at);
      if (path.empty() || end == std::string::npos) return {};
      std::size_t index = 0;
      const auto [last, error] = std::from_chars(text.data() + at + 1, text.data() + end, index);
      if (error != std::errc() || last != text.data() + end) return {};
      path.emplace_back(index);
      at = end + 1;
      if (at < text.size() && text[at] != '[' && text[at] != '.') return {};
    } else {
      if (!path.empty() && text[at++] != '.') return {};
      const std::size_t end = std::min(text.find_first_of(".[", at), text.size());
      if (end == at) return {};
      path.emplace_back(text.substr(at, end - at));
      at = end;
    }
  }
  return path;
}

Place placeOf(const YamlNode& root, const std::string& path) {
  const YamlNode* node = &root;
  for (const PathStep& where : parsePath(path)) {
    const YamlNode* next = step(*node, where);
    if (next == nullptr) break;
    node = next;
  }
  return node->place;
}

}  // namespace burnish::inline schema
