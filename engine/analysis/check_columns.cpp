#include "engine/analysis/check_columns.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/formula_words.h"
#include "engine/core/nearest.h"
#include "engine/scene/quantity_names.h"

namespace burnish::inline analysis {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The name itself when it is a column with a dash, which no formula can name.
std::vector<std::string> namesIn(const std::string& quantity, const std::vector<std::string>& columns) {
  if (contains(columns, quantity)) return {quantity};
  return namesInQuantity(quantity);
}

}  // namespace

std::vector<InputProblem> unknownColumns(const Scene& scene, const std::vector<std::string>& columns) {
  std::vector<std::string> known = columns;
  known.insert(known.end(), {"pi", "e"});
  for (const DefinitionSpec& definition : scene.definitions) known.push_back(definition.name);
  std::vector<InputProblem> problems;
  const auto check = [&](const std::string& path, const std::string& quantity) {
    try {
      for (const std::string& name : namesIn(quantity, known))
        if (!contains(known, name))
          problems.push_back({path, fmt::format("found {}, which is no column of the history; allowed: {}.{}",
                                                name, listed(known), didYouMean(name, known))});
    } catch (const Error& error) {
      problems.push_back({path, error.what()});
    }
  };
  for (const auto& [path, formula] : scene.wanted.quantities) check(path, formula);
  return problems;
}

}  // namespace burnish::inline analysis
