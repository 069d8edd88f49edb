#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/init/scene_kinds.h"
#include "cli/offered_words.h"
#include "cli/output_target.h"
#include "engine/core/error.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

struct InitArguments {
  std::filesystem::path scene;
  std::string kind = "press";
  bool list = false;
};

/// Words and texts, as `chosen` has them.
std::vector<std::pair<std::string, std::string>> kindTexts() {
  std::vector<std::pair<std::string, std::string>> texts;
  for (const SceneKind& kind : sceneKinds()) texts.emplace_back(kind.name, kind.text);
  return texts;
}

ExitCode init(InitArguments arguments) {
  if (arguments.list) {
    for (const SceneKind& kind : sceneKinds()) printOut("{:<14}{}\n", kind.name, kind.sentence());
    return ExitCode::Fine;
  }
  std::filesystem::path& scene = arguments.scene;
  const std::string text = chosen("--kind", arguments.kind, kindTexts());
  if (isStandardOutput(scene)) {
    printText(text);
    return ExitCode::Fine;
  }
  std::error_code absent;
  if (std::filesystem::is_directory(scene, absent))
    throw Error(fmt::format("{}: this is a directory; expected the name of a scene, as in {}", scene.string(),
                            (scene / arguments.kind).lexically_normal().string()));
  if (!scene.has_filename())
    throw Error(fmt::format("{}: there is no such directory; make it, and give the name of a scene in it",
                            scene.string()));
  if (!scene.has_extension()) scene += ".yaml";
  if (scene.extension() != ".yaml" && scene.extension() != ".yml")
    throw Error(fmt::format("{}: found the ending \"{}\"; expected the name of a scene, .yaml",
                            scene.string(), scene.extension().string()));
  if (std::filesystem::symlink_status(scene, absent).type() != std::filesystem::file_type::not_found)
    throw Error(fmt::format("{}: it is there already, and nothing is overwritten; choose another name",
                            scene.string()));
  writeText(text, scene);
  const std::string name = shellWord(scene.string());
  printOut("scene {} of the kind {}; next:\n  burnish validate {}\n  burnish run {}\n", scene.string(),
           arguments.kind, name, name);
  return ExitCode::Fine;
}

}  // namespace

void addInitCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("init", "Write a scene with comments, to begin with");
  const auto arguments = std::make_shared<InitArguments>();
  command->add_option("SCENE", arguments->scene,
                      "Name of the scene, to which .yaml is added if it is missing; - prints it");
  CLI::Option* kind =
      command
          ->add_option("--kind", arguments->kind, "What the scene shows; --list tells of all kinds [press]")
          ->type_name("KIND");
  offerChoices(*kind, kindTexts());
  command->add_flag("--list", arguments->list, "List the kinds of scenes");
  command->callback([&action, arguments] {
    if (arguments->scene.empty() && !arguments->list) throw CLI::RequiredError("SCENE or --list");
    action = [arguments] { return init(*arguments); };
  });
}

}  // namespace burnish
