#pragma once
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace burnish {

/// A command line that ends in a word which is being written.
struct GivenLine {
  const CLI::App* command = nullptr;  ///< none: the word is to name it
  /// Options and arguments with what stands there, as far as the line goes.
  std::vector<std::pair<const CLI::Option*, std::string>> values;
  const CLI::Option* of =
      nullptr;         ///< whose value the word is; none: an option's name, or nothing that is expected
  std::string before;  ///< what of the word is not of the value: --field=
  std::string word;    ///< the rest

  /// The first value of an argument of one of these names, such as RESULT; empty: none.
  std::string argument(const std::vector<std::string>& names) const;
  /// The last value of an option such as --field.
  std::string valueOf(const std::string& option) const;
  bool has(const CLI::Option* option) const;
};

/// words: those behind the name of the program, at least one.
GivenLine givenLine(const CLI::App& program, const std::vector<std::string>& words);

}  // namespace burnish
