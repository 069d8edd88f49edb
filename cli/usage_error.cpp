#include "cli/usage_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <regex>
#include <string>
#include <vector>

#include "cli/command_tree.h"
#include "engine/core/nearest.h"

namespace burnish {
namespace {

std::vector<std::string> subcommandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* subcommand : shownCommands(app)) names.push_back(subcommand->get_name());
  return names;
}

std::vector<std::string> optionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// What the parser says of a value, in the words of this program: the option, what was found and what is expected.
std::string sentenceOf(const CLI::App& command, const std::string& said) {
  std::smatch part;
  if (std::regex_match(said, part, std::regex("(\\S+): Value (.*) not in range (\\S+) to (\\S+)")))
    return fmt::format("{}: found \"{}\"; expected a number from {:g} to {:g}", part[1].str(), part[2].str(),
                       std::stod(part[3]), std::stod(part[4]));
  if (std::regex_match(said, part, std::regex("Could not convert: (\\S+) = (.*)"))) {
    const CLI::Option* option = command.get_option_no_throw(part[1].str());
    const bool isFlag = option != nullptr && option->get_items_expected_max() == 0;
    return fmt::format("{}: found \"{}\"; expected {}", part[1].str(), part[2].str(),
                       isFlag ? "no value" : "a number");
  }
  if (std::regex_match(said, part, std::regex("(\\S+): \\d+ required .* missing")))
    if (const CLI::Option* option = command.get_option_no_throw(part[1].str()))
      return fmt::format("{}: {} is missing behind it", part[1].str(), valueWord(*option));
  return said;
}

}  // namespace

std::string usageMessage(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  const CLI::App& command = parsed.empty() ? app : *parsed.front();
  const std::string help =
      fmt::format("\"burnish {}--help\" explains", parsed.empty() ? "" : command.get_name() + " ");
  const std::vector<std::string> unknown = app.remaining(true);
  if (unknown.empty() && parsed.empty())
    return fmt::format("a command is needed: {}; {}", fmt::join(subcommandNames(app), ", "), help);
  if (unknown.empty()) return fmt::format("{}; {}", sentenceOf(command, error.what()), help);

  const std::string word = unknown.front().substr(0, unknown.front().find('='));
  if (word.starts_with('-'))
    return fmt::format("there is no option {}.{} {}", word, didYouMean(word, optionNames(command)), help);
  if (parsed.empty())
    return fmt::format("there is no command {}.{} {}", word, didYouMean(word, subcommandNames(app)), help);
  return fmt::format("burnish {} does not expect \"{}\"; {}", command.get_name(), word, help);
}

std::string withOption(const CLI::App& app, const std::string& sentence) {
  std::string name = "--" + sentence.substr(0, sentence.find(": "));
  std::ranges::replace(name, '_', '-');
  for (const CLI::App* command : app.get_subcommands())
    if (const CLI::Option* option = command->get_option_no_throw(name); option && option->count() > 0)
      return name + sentence.substr(name.size() - 2);
  return sentence;
}

}  // namespace burnish
