#include "engine/scene/quantity_names.h"

#include <fmt/format.h>
#include <muParser.h>

#include "engine/core/error.h"
#include "engine/core/formula_words.h"
#include "engine/core/quoted.h"

namespace burnish::inline scene {

std::vector<std::string> namesInQuantity(const std::string& quantity) {
  std::vector<std::string> names;
  try {
    mu::Parser probe;
    probe.DefineNameChars("0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
    probe.SetExpr(quantity);
    for (const auto& [name, unused] : probe.GetUsedVar()) names.push_back(name);
  } catch (const mu::ParserError& problem) {
    throw Error(fmt::format(
        "found {}, which cannot be understood: {}; allowed: a column of the history or a formula in columns.",
        quoted(quantity), formulaProblem(quantity, problem)));
  }
  return names;
}

}  // namespace burnish::inline scene
