#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <system_error>

#include "cli/command.h"
#include "cli/info_text.h"
#include "engine/core/error.h"
#include "engine/scene/reader.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

ExitCode info(const fs::path& path) {
  std::error_code status;
  if (!fs::exists(path, status))
    throw Error(fmt::format("{}: there is no such file or directory", path.string()));
  const bool isResult = fs::is_directory(path, status) || path.extension() == ".h5";
  fmt::print("{}", isResult ? resultText(ResultReader(path)) : sceneText(readScene(path)));
  return ExitCode::Fine;
}

}  // namespace

void addInfoCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("info", "Tell what is in a result or a scene");
  const auto path = std::make_shared<fs::path>();
  command->add_option("RESULT|SCENE", *path, "Directory of a run, result file (.h5), or scene file")
      ->required();
  command->callback([&action, path] { action = [path] { return info(*path); }; });
}

}  // namespace burnish
