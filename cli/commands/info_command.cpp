#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include "cli/command.h"
#include "cli/commands/foreign_text.h"
#include "cli/commands/geometry_listing.h"
#include "cli/commands/info_json.h"
#include "cli/commands/info_text.h"
#include "cli/console.h"
#include "cli/scene_input.h"
#include "engine/core/error.h"
#include "engine/schema/diagnostics.h"
#include "postproc/foreign/foreign_file.h"
#include "postproc/scene/scene_listing.h"
#include "postproc/study/study_listing.h"
#include "postproc/text/json_text.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

struct InfoArguments {
  fs::path path;
  bool keys = false, studyKeys = false, json = false;
};

/// Of a file that holds geometry for scenes and exists.
std::optional<GeometryListing> geometryIn(const fs::path& path, bool isResult) {
  return isResult || isStandardInput(path) ? std::nullopt : listGeometry(path);
}

void printJson(const fs::path& path, bool isResult) {
  if (const auto geometry = geometryIn(path, isResult))
    return printText(compactText(geometryJson(*geometry), kJsonDigits) + "\n");
  if (isResult) return printText(compactText(resultJson(ResultReader(path)), kJsonDigits) + "\n");
  if (!foreignKind(path).empty())
    return printText(compactText(foreignJson(ForeignFile(path)), kJsonDigits) + "\n");
  Diagnostics errors(path.string(), {});
  const auto tree = parseYaml(readSceneInput(path).scene.resolvedYaml, 0, errors);
  printText(compactText(documentJson(tree.value()), kJsonDigits) + "\n");
}

ExitCode info(const InfoArguments& arguments) {
  if (arguments.keys) printText(describeScene());
  if (arguments.studyKeys) printText(describeStudy());
  const fs::path& path = arguments.path;
  if (path.empty()) return ExitCode::Fine;
  std::error_code status;
  if (!isStandardInput(path) && !fs::exists(path, status))
    throw Error(fmt::format("{}: there is no such file or directory", path.string()));
  const bool isResult = fs::is_directory(path, status) || path.extension() == ".h5";
  if (arguments.json)
    printJson(path, isResult);
  else if (isResult)
    printText(resultText(ResultReader(path)));
  else if (const auto geometry = geometryIn(path, isResult))
    printText(geometryText(*geometry));
  else
    printText(foreignKind(path).empty() ? sceneText(readSceneInput(path).scene)
                                        : foreignText(ForeignFile(path)));
  return ExitCode::Fine;
}

}  // namespace

void addInfoCommand(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("info", "Tell what is in a result, a scene, or a file of another program or of CAD");
  const auto arguments = std::make_shared<InfoArguments>();
  command->add_option(
      "RESULT|SCENE|FILE", arguments->path,
      "Directory of a run, result file (.h5), scene file, file of another program, or geometry (STEP, IGES, g2, JSON); - for "
      "a scene on standard input");
  command->add_flag("--keys", arguments->keys,
                    "List every key of a scene with its type, default and meaning");
  command->add_flag("--study-keys", arguments->studyKeys, "List every key of a study");
  command->add_flag("--json", arguments->json,
                    "Print what is in the result, scene or file as one JSON object");
  command->callback([&action, arguments] {
    if (arguments->json && arguments->path.empty())
      throw CLI::RequiredError("a result, scene or file for --json");
    if (arguments->path.empty() && !arguments->keys && !arguments->studyKeys)
      throw CLI::RequiredError("a result, scene or file, or --keys or --study-keys");
    action = [arguments] { return info(*arguments); };
  });
}

}  // namespace burnish
