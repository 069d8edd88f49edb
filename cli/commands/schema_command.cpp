#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "cli/broken_lines.h"
#include "cli/command.h"
#include "cli/console.h"
#include "engine/schema/explanation.h"
#include "engine/schema/json_schema.h"
#include "postproc/scene/scene_listing.h"
#include "postproc/study/study_listing.h"

namespace burnish {

void addSchemaCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "schema", "Print the JSON Schema of scenes, with which editors check and complete them");
  const auto study = std::make_shared<bool>(false);
  command->add_flag("--study", *study, "The schema of studies instead");
  command->callback([&action, study] {
    action = [study] {
      printText(*study ? jsonSchema("burnish study", studyDeclarations())
                       : jsonSchema("burnish scene", sceneDeclarations()));
      return ExitCode::Fine;
    };
  });
}

void addExplainCommand(CLI::App& app, Action& action) {
  struct Arguments {
    std::string key;
    bool study = false;
  };
  CLI::App* command = app.add_subcommand("explain", "Tell what a key of a scene means and allows");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("KEY", arguments->key, "A key such as solver.tolerance or tools[0].motion.x")
      ->required();
  command->add_flag("--study", arguments->study, "A key of a study instead");
  command->callback([&action, arguments] {
    action = [arguments] {
      printText(brokenText(
          explainKey(arguments->study ? studyDeclarations() : sceneDeclarations(), arguments->key)));
      return ExitCode::Fine;
    };
  });
}

}  // namespace burnish
