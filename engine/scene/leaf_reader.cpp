#include "engine/scene/leaf_reader.h"

#include <charconv>
#include <cmath>

#include "engine/core/shown_text.h"

namespace burnish {
namespace {

enum class Parsed { Number, NotFinite, NoNumber };

bool isOneOf(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* word : words)
    if (text == word) return true;
  return false;
}

/// The number that a plain scalar spells in full: no blanks, no units, no expressions.
template <class T>
Parsed parseNumber(const YamlNode& node, T& value) {
  if (node.kind != YamlNode::Kind::Scalar || node.quoted) return Parsed::NoNumber;
  std::string text = node.text;
  if (text.starts_with('+')) text.erase(0, 1);
  if (text.starts_with('+') || text.empty()) return Parsed::NoNumber;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range && end == text.data() + text.size()) return Parsed::NotFinite;
  if (error != std::errc() || end != text.data() + text.size()) {
    if (text.starts_with('-')) text.erase(0, 1);
    return isOneOf(text, {".inf", ".Inf", ".INF", ".nan", ".NaN", ".NAN"}) ? Parsed::NotFinite
                                                                           : Parsed::NoNumber;
  }
  if constexpr (std::is_floating_point_v<T>) return std::isfinite(value) ? Parsed::Number : Parsed::NotFinite;
  return Parsed::Number;
}

}  // namespace

void LeafReader::read(const YamlNode& node, const std::string& path, double& value, const Rule& rule) {
  double number = 0.0;
  const Parsed parsed = parseNumber(node, number);
  if (parsed == Parsed::NotFinite)
    return reject(node, path, allowedText<double>(rule) + " that is finite and fits into double precision");
  if (parsed != Parsed::Number || !rule.admits(number)) return reject(node, path, allowedText<double>(rule));
  value = number;
}

void LeafReader::read(const YamlNode& node, const std::string& path, int& value, const Rule& rule) {
  int number = 0;
  if (parseNumber(node, number) != Parsed::Number || !rule.admits(static_cast<double>(number)))
    return reject(node, path, allowedText<int>(rule));
  value = number;
}

void LeafReader::read(const YamlNode& node, const std::string& path, bool& value, const Rule& rule) {
  const bool plain = node.kind == YamlNode::Kind::Scalar && !node.quoted;
  if (plain && isOneOf(node.text, {"true", "True", "TRUE"})) {
    value = true;
  } else if (plain && isOneOf(node.text, {"false", "False", "FALSE"})) {
    value = false;
  } else {
    reject(node, path, allowedText<bool>(rule));
  }
}

void LeafReader::read(const YamlNode& node, const std::string& path, std::string& value, const Rule& rule) {
  if (node.kind != YamlNode::Kind::Scalar || !rule.admits(node.text))
    return reject(node, path, allowedText<std::string>(rule), rule.choices);
  const std::size_t most = rule.mostLetters();
  if (const std::string fault = most > 0 ? shownTextFault(node.text, most) : ""; !fault.empty())
    return errors_.add(node.place, path, fault + ".");
  value = node.text;
}

void LeafReader::read(const YamlNode& node, const std::string& path, FormulaText& value, const Rule& rule) {
  if (node.kind != YamlNode::Kind::Scalar || node.text.empty())
    return reject(node, path, allowedText<FormulaText>(rule));
  value.text = node.text;
}

void LeafReader::reject(const YamlNode& node, const std::string& path, const std::string& allowed,
                        const std::vector<std::string>& candidates) {
  const std::string hint = node.kind == YamlNode::Kind::Scalar ? didYouMean(node.text, candidates) : "";
  errors_.add(node.place, path, fmt::format("found {}; allowed: {}.{}", node.describe(), allowed, hint));
}

}  // namespace burnish
