#include "postproc/scene/scene_listing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/core/formula_words.h"
#include "engine/schema/declaration_collector.h"
#include "postproc/scene/schema_document.h"

namespace burnish {

Declarations sceneDeclarations() {
  return declarationsOf<SceneDocument>();
}

std::string describeScene() {
  return fmt::format(
      "{}\n## Formulas\n\n"
      "What formulas know beside the variables of their keys and the `definitions` before them. A number may "
      "be a formula of `pi` and `e` alone, such as `2*pi`.\n\n"
      "| | |\n| --- | --- |\n"
      "| functions | `{}` (`log` and `ln` are natural; `avg`, `max`, `min` and `sum` take any number of "
      "values) |\n"
      "| constants | `pi`, `e`, unless a definition has this name (`_pi` and `_e` as well) |\n"
      "| operators | `+`, `-`, `*`, `/`, `^`; `<`, `<=`, `>`, `>=`, `==`, `!=`; `&&`, `\\|\\|`; `a ? b : c` "
      "|\n",
      listKeys(sceneDeclarations()), fmt::join(formulaFunctions(), "`, `"));
}

}  // namespace burnish
