#include "engine/schema/leaf_reader.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "engine/core/shown_text.h"

namespace burnish::inline schema {
namespace {

enum class Parsed { Number, NotFinite, TooLarge, NoNumber };

bool isOneOf(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* word : words)
    if (text == word) return true;
  return false;
}

/// The value of a text that is a formula of numbers and the constants pi or e, such as 2*pi.
std::optional<double> multipleOfConstant(const std::string& text) {
  const auto isWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  const auto mentions = [&](std::string_view name) {
    for (std::size_t k = text.find(name); k != std::string::npos; k = text.find(name, k + 1)) {
      const std::size_t end = k + name.size();
      if ((k == 0 || !isWord(text[k - 1])) && (end == text.size() || !isWord(text[end]))) return true;
    }
    return false;
  };
  constexpr std::size_t kLongest = 60;
  if (text.size() > kLongest || (!mentions("pi") && !mentions("e"))) return std::nullopt;
  try {
    return Formula({text}, {}, {}).at({});
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// The same with a point, of a number with a decimal comma.
std::optional<std::string> withPoint(const std::string& text) {
  const std::size_t comma = text.find(',');
  const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  if (comma == std::string::npos || comma == 0 || comma + 1 == text.size()) return std::nullopt;
  const std::string sign = text.substr(0, text.find_first_not_of("+-"));
  const std::string before = text.substr(sign.size(), comma - sign.size()), behind = text.substr(comma + 1);
  if (sign.size() > 1 || before.empty() || !std::all_of(before.begin(), before.end(), isDigit))
    return std::nullopt;
  if (behind.find_first_not_of("0123456789eE+-") != std::string::npos || !isDigit(behind.front()))
    return std::nullopt;
  return sign + before + "." + behind;
}

/// The number that a plain scalar spells in full: no blanks, no units.
template <class T>
Parsed parseNumber(const YamlNode& node, T& value) {
  if (node.kind != YamlNode::Kind::Scalar || node.quoted) return Parsed::NoNumber;
  std::string text = node.text;
  if (text.starts_with('+')) text.erase(0, 1);
  if (text.starts_with('+') || text.empty()) return Parsed::NoNumber;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range && end == text.data() + text.size()) return Parsed::TooLarge;
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
  Parsed parsed = parseNumber(node, number);
  if (parsed == Parsed::NotFinite || parsed == Parsed::TooLarge)
    return reject(node, path,
                  fmt::format("{} that is finite and fits into double precision{}", allowedText<double>(rule),
                              parsed == Parsed::TooLarge ? ", between 1e-308 and 1e308 in size" : ""));
  if (parsed == Parsed::NoNumber && node.kind == YamlNode::Kind::Scalar && !node.quoted)
    if (const auto constant = multipleOfConstant(node.text)) {
      number = *constant;
      parsed = Parsed::Number;
    }
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

void LeafReader::read(const YamlNode& node, const std::string& path, Coordinates& value, const Rule& rule) {
  std::vector<double> entries = value.given();
  read(node, path, entries, ruleOf<Coordinates>(rule));
  value = Coordinates(entries);
}

void LeafReader::read(const YamlNode& node, const std::string& path, Eigen::Vector3d& value,
                      const Rule& rule) {
  std::array<double, 3> entries{value.x(), value.y(), value.z()};
  read(node, path, entries, rule);
  value = Eigen::Vector3d(entries[0], entries[1], entries[2]);
}

void LeafReader::reject(const YamlNode& node, const std::string& path, const std::string& allowed,
                        const std::vector<std::string>& candidates) {
  std::string hint = node.kind == YamlNode::Kind::Scalar ? didYouMean(node.text, candidates) : "";
  if (const auto number = withPoint(node.text); number && candidates.empty())
    hint = fmt::format(" Write {}, with a point.", *number);
  errors_.add(node.place, path, fmt::format("found {}; allowed: {}.{}", node.describe(), allowed, hint));
}

}  // namespace burnish::inline schema
