#pragma once
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

}  // namespace burnish
