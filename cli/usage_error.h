#pragma once
#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace burnish {

/// One sentence on a command line that could not be understood, with the nearest valid option or subcommand
/// and where to find help.
std::string usageMessage(const CLI::App& app, const CLI::ParseError& error);

/// A sentence that begins with a key, such as "print_field: ", with the option instead that gave it its value; as it
/// is if there was none.
std::string withOption(const CLI::App& app, const std::string& sentence);

}  // namespace burnish
