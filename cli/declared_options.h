#pragma once
#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/offered_words.h"
#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "engine/schema/declaration_collector.h"
#include "engine/schema/leaf_reader.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// Options of commands that follow from the declaration of a struct: its `describe` gives their names, help
/// and rules. The key `tool_opacity` is the option `--tool-opacity`; the entries of a list stand between
/// commas; a truth value is a flag, or with the default true an option that is on or off.
namespace burnish {

/// Visitor that collects the words which keys may be given, as far as they can be listed.
class ProposedWords {
 public:
  static constexpr bool declares = true;

  template <class T>
  void field(const char* key, T& /*value*/, const Rule& rule, const char* /*sentence*/) {
    using Inner = typename Underlying<T>::Type;
    if constexpr (Spelled<Inner>)
      words_[key] = Spelling<Inner>::candidates();
    else if constexpr (std::is_enum_v<Inner>)
      words_[key] = enumNames<Inner>();
    else if constexpr (std::is_same_v<Inner, bool>)
      words_[key] = {"on", "off"};
    else
      words_[key] = rule.choices;
  }

  const std::vector<std::string>& of(const std::string& key) const { return words_.at(key); }

 private:
  std::map<std::string, std::vector<std::string>> words_;
};

/// What the options of a command were given, until they are read into the struct.
class DeclaredOptions {
 public:
  /// Words of an option that stand for values: `smooth` for 0 bands.
  using Words = std::vector<std::pair<std::string, std::string>>;

  /// Adds an option for every key of the struct. fresh: has the defaults. usual: what help says of a default,
  /// by key, where it is not the value. The command must not outlive the object.
  template <class T>
  void addTo(CLI::App& command, T fresh, const std::map<std::string, std::string>& usual = {}) {
    Declarations keys;
    DeclarationCollector collector(keys);
    describe(collector, fresh);
    ProposedWords words;
    describe(words, fresh);
    for (const Declaration& key : keys) {
      const auto said = usual.find(key.key);
      CLI::Option& option = add(command, key, said != usual.end() ? said->second : defaultText(key));
      offerWords(option, words.of(key.key));
    }
  }

  /// Other words for values of a key.
  void allow(const std::string& key, Words words) { words_[key] = std::move(words); }

  /// What is expected of a key, in words, where its rule says less.
  void expect(const std::string& key, const std::string& words) { expected_[key] = words; }

  /// Adds a flag by another name that gives a key this value.
  void addFlag(CLI::App& command, const char* flag, const std::string& key, const std::string& text,
               const std::string& help);

  /// Replaces what was given. Throws `Error` that names the option, what was found and what is expected.
  template <class T>
  void readInto(T& value) const;

 private:
  class Reader;

  CLI::Option& add(CLI::App& command, const Declaration& key, const std::string& usual);
  static std::string defaultText(const Declaration& key);

  std::map<std::string, std::string> given_;  ///< by key
  std::map<std::string, Words> words_;
  std::map<std::string, std::string> expected_;
};

/// `tool_opacity` as `--tool-opacity`.
std::string optionName(std::string key);

/// Visitor that reads what was given.
class DeclaredOptions::Reader {
 public:
  static constexpr bool fills = true;

  explicit Reader(const DeclaredOptions& options) : options_(options) {}

  template <class T>
  void field(const char* key, T& value, const Rule& rule, const char* /*sentence*/) {
    const auto given = options_.given_.find(key);
    if (given != options_.given_.end()) read(key, given->second, value, rule);
  }

 private:
  template <class T>
  void read(const char* key, const std::string& text, T& value, const Rule& rule) const {
    if constexpr (Optional<T>) {
      read(key, text, value.emplace(), rule);
    } else if constexpr (Spelled<T>) {
      const auto found = Spelling<T>::read(text);
      if (!found) reject(key, text, Spelling<T>::words(), Spelling<T>::candidates());
      value = *found;
    } else {
      Diagnostics errors("", {});
      LeafReader(errors).read(nodeOf(meant<T>(key, text), List<T>), key, value, rule);
      if (errors.clean(key)) return;
      if constexpr (std::is_same_v<T, std::string>)
        if (const std::size_t most = rule.mostLetters(); most > 0 && rule.admits(text))
          throw Error(fmt::format("{}: {}", optionName(key), shownTextFault(text, most)));
      reject(key, text, std::is_same_v<T, bool> ? "on or off" : allowedText<T>(rule), choices<T>(key, rule));
    }
  }

  /// The text, or what it stands for.
  template <class T>
  std::string meant(const char* key, const std::string& text) const {
    for (const auto& [word, value] : words<T>(key))
      if (text == word) return value;
    return text;
  }

  template <class T>
  Words words(const char* key) const {
    if constexpr (std::is_same_v<T, bool>) return {{"on", "true"}, {"off", "false"}};
    const auto found = options_.words_.find(key);
    return found == options_.words_.end() ? Words() : found->second;
  }

  template <class T>
  std::vector<std::string> choices(const char* key, const Rule& rule) const {
    std::vector<std::string> names = rule.choices;
    if constexpr (std::is_enum_v<T>) names = enumNames<T>();
    for (const auto& [word, value] : words<T>(key)) names.push_back(word);
    return names;
  }

  /// A scalar, or a list of the parts between commas.
  static YamlNode nodeOf(const std::string& text, bool isList);

  [[noreturn]] void reject(const char* key, const std::string& text, const std::string& allowed,
                           const std::vector<std::string>& candidates) const;

  const DeclaredOptions& options_;
};

template <class T>
void DeclaredOptions::readInto(T& value) const {
  Reader reader(*this);
  describe(reader, value);
}

/// Visitor that spells values as options do.
class OptionSpeller {
 public:
  template <class T>
  void field(const char* key, T& value, const Rule& rule, const char* sentence) {
    if constexpr (Optional<T>) {
      if (value) field(key, *value, rule, sentence);
    } else {
      texts_[key] = optionText(value);
    }
  }

  const std::map<std::string, std::string>& texts() const { return texts_; }

 private:
  template <class T>
  static std::string optionText(const T& value) {
    if constexpr (Spelled<T>) {
      return Spelling<T>::write(value);
    } else if constexpr (List<T>) {
      std::string text;
      for (const auto& entry : value) text += (text.empty() ? "" : ",") + optionText(entry);
      return text;
    } else if constexpr (std::is_enum_v<T>) {
      for (const auto& [name, candidate] : kNamesOf<T>)
        if (candidate == value) return name;
      return "";
    } else if constexpr (std::is_same_v<T, bool>) {
      return value ? "on" : "off";
    } else {
      return fmt::format("{}", value);
    }
  }

  std::map<std::string, std::string> texts_;  ///< by key
};

/// The options that make this of a fresh struct, for the shell: " --size 300,200 --knots".
std::string optionsText(const OptionSpeller& wanted, const OptionSpeller& fresh);

template <class T>
std::string optionsText(T value, T usual = {}) {
  OptionSpeller wanted, fresh;
  describe(wanted, value);
  describe(fresh, usual);
  return optionsText(wanted, fresh);
}

}  // namespace burnish
