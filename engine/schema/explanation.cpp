#include "engine/schema/explanation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "engine/schema/yaml_tree.h"

namespace burnish::inline schema {
namespace {

/// A key of that name, and which alternatives have to be chosen for it: "tools.shape: cylinder".
struct Match {
  const Declaration* key;
  std::vector<std::string> with;
};

std::string joinedPath(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

/// Calls `act(key, with)` for every key of a mapping at `path`, those of its alternatives included.
void forEachKey(const Declarations& keys, const std::string& path, const std::vector<std::string>& with,
                const std::function<void(const Declaration&, const std::vector<std::string>&)>& act) {
  for (const Declaration& key : keys) {
    act(key, with);
    for (const DeclaredAlternative& alternative : key.alternatives) {
      auto chosen = with;
      chosen.push_back(fmt::format("{}: {}", joinedPath(path, key.key), alternative.about.name));
      forEachKey(alternative.keys, path, chosen, act);
    }
  }
}

/// Paths of all keys, each once.
void collectPaths(const Declarations& keys, const std::string& path, std::vector<std::string>& paths) {
  forEachKey(keys, path, {}, [&](const Declaration& key, const auto&) {
    const std::string full = joinedPath(path, key.key);
    if (std::find(paths.begin(), paths.end(), full) == paths.end()) paths.push_back(full);
    collectPaths(key.below, full, paths);
  });
}

std::string lastOf(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

/// Where else the word is a key, the nearest of its neighbours, or the nearest of all keys.
[[noreturn]] void rejectKey(const Declarations& keys, const std::string& given, const std::string& parent,
                            const std::string& word, const std::vector<std::string>& neighbours) {
  std::vector<std::string> paths, same, words;
  collectPaths(keys, "", paths);
  for (const std::string& path : paths) {
    if (lastOf(path) == word) same.push_back(path);
    words.push_back(lastOf(path));
  }
  std::string hint = didYouMean(word, neighbours);
  if (hint.empty() && !same.empty())
    hint = fmt::format(" The keys of this name are {}.", fmt::join(same, ", "));
  if (hint.empty()) {
    const auto close = nearest(word, words);
    for (const std::string& path : paths)
      if (close && lastOf(path) == *close) same.push_back(path);
    if (!same.empty()) hint = fmt::format(" Did you mean {}?", fmt::join(same, " or "));
  }
  const std::string place = parent.empty() ? "a key of the document" : fmt::format("a key of {}", parent);
  throw Error(fmt::format("{}: \"{}\" is not {}; allowed: {}.{}", given, word, place,
                          neighbours.empty() ? "no keys" : fmt::format("{}", fmt::join(neighbours, ", ")),
                          hint));
}

std::vector<Match> find(const Declarations& keys, const std::string& given) {
  std::vector<Match> matches{{nullptr, {}}};
  std::string path;
  for (const PathStep& step : parsePath(given)) {
    const auto* word = std::get_if<std::string>(&step);
    if (word == nullptr) continue;  // entries of a list are alike
    std::vector<Match> next;
    std::vector<std::string> neighbours;
    for (const Match& match : matches)
      forEachKey(match.key == nullptr ? keys : match.key->below, path, match.with,
                 [&](const Declaration& key, const auto& with) {
                   if (std::find(neighbours.begin(), neighbours.end(), key.key) == neighbours.end())
                     neighbours.push_back(key.key);
                   if (key.key == *word) next.push_back({&key, with});
                 });
    if (next.empty()) rejectKey(keys, given, path, *word, neighbours);
    matches = std::move(next);
    path = joinedPath(path, *word);
  }
  return matches;
}

std::string row(const std::string& label, const std::string& text) {
  return fmt::format("  {:<9}{}\n", label, text);
}

std::string alternativesText(const Declaration& chooser) {
  std::string text;
  for (const auto& [about, own] : chooser.alternatives) {
    std::vector<std::string> names;
    for (const Declaration& key : own) names.push_back(key.key);
    text += fmt::format("  {}: {}{}\n", about.name, about.sentence,
                        names.empty() ? "" : fmt::format(" Its keys: {}.", fmt::join(names, ", ")));
  }
  return text;
}

std::string explanation(const Declaration& key) {
  std::string text = fmt::format("  {}\n", key.sentence);
  text += row("allowed", key.allowed);
  if (!key.rule.unit.empty()) text += row("unit", key.rule.unit);
  text += row("default", key.rule.required && !key.rule.unless.empty()
                             ? fmt::format("none, the key is required without {}", key.rule.unless)
                         : key.rule.required ? "none, the key is required"
                         : key.defaultValue  ? *key.defaultValue
                                             : "none, the key may be left out");
  text += alternativesText(key);
  if (!key.below.empty()) text += "  keys\n";
  for (const Declaration& below : key.below)
    text += fmt::format("    {}: {}. {}\n", below.key, below.allowed, below.sentence);
  return text;
}

}  // namespace

std::string explainKey(const Declarations& keys, const std::string& key) {
  if (parsePath(key).empty())
    throw Error(
        fmt::format("found \"{}\"; allowed: a key such as tools[0].motion.x or solver.tolerance", key));
  std::string text = key + "\n";
  std::string before;
  for (const Match& match : find(keys, key)) {
    const std::string body = explanation(*match.key);
    const std::string with = match.with.empty() ? "" : fmt::format("with {}\n", fmt::join(match.with, ", "));
    // Alternatives that mean the same by a key share its explanation.
    if (body == before) {
      text.insert(text.size() - body.size(), with);
    } else {
      text += with + body;
    }
    before = body;
  }
  return text;
}

}  // namespace burnish::inline schema
