#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/command_tree.h"
#include "cli/console.h"
#include "cli/manual/manual_pages.h"
#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

const CLI::App& commandOf(const CLI::App& program, const std::string& name) {
  std::vector<std::string> names;
  for (const CLI::App* command : shownCommands(program)) {
    if (command->get_name() == name) return *command;
    names.push_back(command->get_name());
  }
  throw Error(fmt::format("there is no command {}; expected {}.{}", name, fmt::join(names, ", "),
                          didYouMean(name, names)));
}

/// As --help prints it.
ExitCode help(const CLI::App& program, const std::string& command) {
  const CLI::App& explained = command.empty() ? program : commandOf(program, command);
  const std::string called = command.empty() ? program.get_name() : program.get_name() + " " + command;
  printText(program.get_formatter()->make_help(&explained, called, CLI::AppFormatMode::Normal));
  return ExitCode::Fine;
}

ExitCode writeManual(const CLI::App& program, const std::filesystem::path& directory) {
  for (const auto& [name, text] : manualPages(program)) {
    makeDirectory((directory / name).parent_path());
    writeText(text, directory / name);
  }
  return ExitCode::Fine;
}

}  // namespace

void addHelpCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("help", "Tell what a command does, and its options");
  const auto name = std::make_shared<std::string>();
  command->add_option("COMMAND", *name, "A command such as run [the list of all]");
  command->callback([&action, &app, name] { action = [&app, name] { return help(app, *name); }; });
}

void addManualCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("manual", "Write the manual pages into a directory")->group("");
  const auto directory = std::make_shared<std::filesystem::path>();
  command->add_option("DIR", *directory, "Directory for man1 and man5")->required();
  command->callback(
      [&action, &app, directory] { action = [&app, directory] { return writeManual(app, *directory); }; });
}

}  // namespace burnish
