#include "cli/command_tree.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <regex>
#include <set>

namespace burnish {
namespace {

/// "from 1 to 9" of the type N:INT in [1 - 9]; empty where there is no range.
std::string rangeWords(const std::string& type) {
  std::smatch range;
  if (!std::regex_search(type, range, std::regex(R"(:.*in \[(.*) - (.*)\])"))) return "";
  return fmt::format("from {} to {}", range[1].str(), range[2].str());
}

/// --a, --b: names of options that help lists, which a set of pointers has in no order.
std::string namesOf(const std::set<CLI::Option*>& options) {
  std::set<std::string> names;
  for (const CLI::Option* option : options)
    if (!option->get_group().empty()) names.insert(option->get_name(option->get_positional()));
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::vector<const CLI::App*> shownCommands(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<const CLI::Option*> shownOptions(const CLI::App& command, bool positional) {
  return command.get_options([=](const CLI::Option* option) {
    return !option->get_group().empty() && option->get_positional() == positional;
  });
}

std::string valueWord(const CLI::Option& option) {
  if (option.get_positional() || option.get_items_expected_max() == 0) return "";
  const std::string type = option.get_type_name();
  return type.substr(0, type.find(':'));
}

std::string meaningOf(const CLI::Option& option) {
  std::string text = option.get_description();
  if (const std::string range = rangeWords(option.get_type_name()); !range.empty()) text += "; " + range;
  if (const std::string others = namesOf(option.get_needs()); !others.empty())
    text += ". Only with " + others;
  if (const std::string others = namesOf(option.get_excludes()); !others.empty())
    text += ". Not with " + others;
  return text;
}

}  // namespace burnish
