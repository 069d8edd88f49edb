#include "cli/completion/given_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/command_tree.h"

namespace burnish {
namespace {

bool takesValue(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

/// Reads one word after the other.
class LineReader {
 public:
  explicit LineReader(GivenLine& line) : line_(line), places_(shownOptions(*line.command, true)) {}

  void read(const std::string& word) {
    if (pending_ != nullptr) {
      line_.values.emplace_back(pending_, word);
      pending_ = nullptr;
    } else if (word == "--" && !endsOptions_) {
      endsOptions_ = true;
    } else if (isOption(word)) {
      const std::size_t equals = word.find('=');
      const CLI::Option* option = line_.command->get_option_no_throw(word.substr(0, equals));
      if (option == nullptr) return;
      const bool isComplete = equals != std::string::npos || !takesValue(*option);
      if (isComplete)
        line_.values.emplace_back(option, equals == std::string::npos ? "" : word.substr(equals + 1));
      else
        pending_ = option;
    } else if (const CLI::Option* place = nextPlace()) {
      line_.values.emplace_back(place, word);
    }
  }

  void readLast(const std::string& word) {
    line_.word = word;
    if (pending_ != nullptr) {
      line_.of = pending_;
      return;
    }
    if (!isOption(word)) {
      line_.of = nextPlace();
      return;
    }
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) return;
    line_.of = line_.command->get_option_no_throw(word.substr(0, equals));
    line_.before = word.substr(0, equals + 1);
    line_.word = word.substr(equals + 1);
  }

 private:
  bool isOption(const std::string& word) const {
    return !endsOptions_ && word.starts_with('-') && word != "-";
  }

  /// The argument that the next word is.
  const CLI::Option* nextPlace() const {
    for (const CLI::Option* place : places_)
      if (!line_.has(place) || place->get_items_expected_max() > 1) return place;
    return nullptr;
  }

  GivenLine& line_;
  std::vector<const CLI::Option*> places_;
  const CLI::Option* pending_ = nullptr;
  bool endsOptions_ = false;
};

}  // namespace

std::string GivenLine::argument(const std::vector<std::string>& names) const {
  for (const auto& [option, value] : values)
    if (option->get_positional() && std::ranges::find(names, option->get_name(true)) != names.end())
      return value;
  return "";
}

std::string GivenLine::valueOf(const std::string& option) const {
  std::string found;
  for (const auto& [given, value] : values)
    if (!given->get_positional() && given->check_name(option)) found = value;
  return found;
}

bool GivenLine::has(const CLI::Option* option) const {
  return std::ranges::any_of(values, [=](const auto& given) { return given.first == option; });
}

GivenLine givenLine(const CLI::App& program, const std::vector<std::string>& words) {
  GivenLine line;
  line.word = words.back();
  if (words.size() == 1) return line;
  for (const CLI::App* command : shownCommands(program))
    if (command->get_name() == words.front()) line.command = command;
  if (line.command == nullptr) return line;
  LineReader reader(line);
  for (std::size_t k = 1; k + 1 < words.size(); ++k) reader.read(words[k]);
  reader.readLast(words.back());
  return line;
}

}  // namespace burnish
