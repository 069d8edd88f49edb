#include "cli/declared_options.h"

#include <yaml-cpp/yaml.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>

#include "cli/arguments.h"

namespace burnish {
namespace {

using Kind = ValueType::Kind;

/// The place of a value in help.
std::string typeName(const Declaration& key) {
  std::string name = "TEXT";
  if (key.type.kind == Kind::Truth) name = "on|off";
  if (key.type.kind == Kind::Whole) name = "N";
  if (key.type.kind == Kind::Number) name = "X";
  if (key.type.kind == Kind::Choice || !key.rule.choices.empty()) name = "NAME";
  if (key.type.lists == 0) return name;
  std::string list = name;
  for (std::size_t k = 1; k < key.type.length; ++k) list += "," + name;
  return list;
}

/// The sentence of the declaration, with what is allowed where a word says it.
std::string helpOf(const Declaration& key, const std::string& usual) {
  std::string text = key.sentence.substr(0, key.sentence.find_last_not_of('.') + 1);
  const bool isText = key.type.kind == Kind::Text && key.rule.choices.empty();
  if (key.type.kind != Kind::Truth && !isText) text += ": " + key.allowed;
  return usual.empty() ? text : fmt::format("{} [{}]", text, usual);
}

/// A default as an option has it: 1600,900 for [1600, 900].
std::string textOf(const YAML::Node& yaml, Kind kind) {
  if (kind == Kind::Truth) return yaml.as<bool>() ? "on" : "off";
  if (!yaml.IsSequence()) return yaml.Scalar();
  std::string text;
  for (const auto& entry : yaml) text += (text.empty() ? "" : ",") + textOf(entry, kind);
  return text;
}

}  // namespace

std::string optionName(std::string key) {
  std::replace(key.begin(), key.end(), '_', '-');
  return "--" + key;
}

std::string DeclaredOptions::defaultText(const Declaration& key) {
  return key.defaultValue ? textOf(YAML::Load(*key.defaultValue), key.type.kind) : "";
}

CLI::Option& DeclaredOptions::add(CLI::App& command, const Declaration& key, const std::string& usual) {
  const std::string option = optionName(key.key);
  if (key.type.kind == Kind::Truth && key.defaultValue == "false") {
    return *command.add_flag_function(
        fmt::format("{},!--no-{}", option, option.substr(2)),
        [this, name = key.key](std::int64_t count) { given_[name] = count > 0 ? "on" : "off"; },
        helpOf(key, usual));
  }
  CLI::Option* added = command.add_option_function<std::string>(
      option, [this, name = key.key](const std::string& text) { given_[name] = text; }, helpOf(key, usual));
  added->type_name(typeName(key));
  if (key.type.kind == Kind::Text && key.type.lists == 1) added->join(',');  // given once or several times
  return *added;
}

void DeclaredOptions::addFlag(CLI::App& command, const char* flag, const std::string& key,
                              const std::string& text, const std::string& help) {
  command.add_flag_function(
      flag, [this, key, text](std::int64_t) { given_[key] = text; }, help);
}

YamlNode DeclaredOptions::Reader::nodeOf(const std::string& text, bool isList) {
  YamlNode node{.kind = YamlNode::Kind::Scalar, .text = text};
  if (!isList) return node;
  YamlNode list{.kind = YamlNode::Kind::Sequence};
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    node.text = text.substr(begin, comma - begin);
    list.children.push_back(node);
    begin = comma + 1;
  }
  return list;
}

void DeclaredOptions::Reader::reject(const char* key, const std::string& text, const std::string& allowed,
                                     const std::vector<std::string>& candidates) const {
  const auto expected = options_.expected_.find(key);
  throw Error(fmt::format("{}: found \"{}\"; expected {}.{}", optionName(key), text,
                          expected == options_.expected_.end() ? allowed : expected->second,
                          didYouMean(text, candidates)));
}

std::string optionsText(const OptionSpeller& wanted, const OptionSpeller& fresh) {
  std::string line;
  for (const auto& [key, text] : wanted.texts()) {
    const auto usual = fresh.texts().find(key);
    if (usual != fresh.texts().end() && usual->second == text) continue;
    const bool isFlag = usual != fresh.texts().end() && usual->second == "off" && text == "on";
    line += " " + optionName(key);
    if (!isFlag) line += " " + shellWord(text);
  }
  return line;
}

}  // namespace burnish
