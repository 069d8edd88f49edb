#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// What the command line knows of itself, as help, manual pages and completion show it.
namespace burnish {

/// The commands that help lists.
std::vector<const CLI::App*> shownCommands(const CLI::App& program);

/// The options of a command that help lists: those with a place of their own, or those with names.
std::vector<const CLI::Option*> shownOptions(const CLI::App& command, bool positional);

/// What stands for the value of an option, such as N; empty of a flag, and of an argument with a place of its own.
std::string valueWord(const CLI::Option& option);

/// What an option does, the range of its number, and the options that it goes with or not: sentences without the last full stop.
std::string meaningOf(const CLI::Option& option);

}  // namespace burnish
