#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <system_error>

#include "cli/command.h"
#include "cli/info_text.h"
#include "engine/core/error.h"
#include "engine/scene/reader.h"
#include "engine/scene/scene_listing.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

ExitCode info(const fs::path& path, bool listKeys) {
  if (listKeys) fmt::print("{}", describeScene());
  if (path.empty()) return ExitCode::Fine;
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
  const auto listKeys = std::make_shared<bool>(false);
  command->add_option("RESULT|SCENE", *path, "Directory of a run, result file (.h5), or scene file");
  command->add_flag("--keys", *listKeys, "List every key of a scene with its type, default and meaning");
  command->require_option(1, 2);
  command->callback(
      [&action, path, listKeys] { action = [path, listKeys] { return info(*path, *listKeys); }; });
}

}  // namespace burnish
