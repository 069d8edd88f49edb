#include "cli/completion/completion.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <sstream>

#include "cli/command_tree.h"
#include "cli/completion/given_line.h"
#include "cli/completion/value_candidates.h"

namespace burnish {
namespace {

/// So much of a sentence as a list of candidates has room for.
std::string shortened(std::string text) {
  constexpr std::size_t kMost = 64;
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\t'; }, ' ');
  if (text.size() <= kMost) return text;
  std::size_t end = text.rfind(' ', kMost);
  if (end == std::string::npos) end = kMost;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end) + " ...";
}

bool isRepeatable(const CLI::Option& option) {
  using Policy = CLI::MultiOptionPolicy;
  const Policy policy = option.get_multi_option_policy();
  return option.get_items_expected_max() > 1 ||
         (option.get_items_expected_max() == 1 && (policy == Policy::TakeAll || policy == Policy::Join));
}

/// Names of the options that are still possible.
std::vector<Candidate> optionCandidates(const CLI::App& command, const GivenLine* line) {
  std::vector<Candidate> out;
  for (const CLI::Option* option : shownOptions(command, false)) {
    if (line != nullptr && line->has(option) && !isRepeatable(*option)) continue;
    const auto& excluded = option->get_excludes();
    if (line != nullptr &&
        std::ranges::any_of(excluded, [&](const CLI::Option* other) { return line->has(other); }))
      continue;
    for (const std::string& name : option->get_lnames())
      out.push_back({"--" + name, option->get_description()});
  }
  return out;
}

std::vector<Candidate> possible(const CLI::App& program, const GivenLine& line, bool atBegin) {
  if (line.command == nullptr) {
    if (!atBegin) return {};
    if (line.word.starts_with('-')) return optionCandidates(program, nullptr);
    std::vector<Candidate> out;
    for (const CLI::App* command : shownCommands(program))
      out.push_back({command->get_name(), command->get_description()});
    return out;
  }
  if (line.of == nullptr) return optionCandidates(*line.command, &line);
  try {
    return valueCandidates(program, line);
  } catch (const std::exception&) {
    return {};  // a result that cannot be read: who runs the command is told why
  }
}

}  // namespace

std::vector<Candidate> candidates(const CLI::App& program, const std::vector<std::string>& words) {
  const std::vector<std::string> read = words.empty() ? std::vector<std::string>{""} : words;
  GivenLine line = givenLine(program, read);
  // Of a list between commas the last entry, which is none of those before.
  std::vector<std::string> listed;
  if (line.of != nullptr && line.of->get_type_name().find(",...") != std::string::npos) {
    const std::size_t begun = line.word.rfind(',') + 1;
    std::istringstream entries(line.word.substr(0, begun));
    for (std::string entry; std::getline(entries, entry, ',');) listed.push_back(entry);
    line.before += line.word.substr(0, begun);
    line.word.erase(0, begun);
  }
  std::vector<Candidate> out;
  for (const Candidate& candidate : possible(program, line, read.size() == 1)) {
    const bool isTwice = std::ranges::find(out, line.before + candidate.text, &Candidate::text) != out.end();
    const bool isListed = std::ranges::find(listed, candidate.text) != listed.end();
    if (candidate.text.starts_with(line.word) && !isTwice && !isListed)
      out.push_back({line.before + candidate.text, shortened(candidate.about)});
  }
  return out;
}

std::vector<std::string> shellWords(const std::string& line) {
  std::vector<std::string> words{""};
  char quote = 0;
  bool begun = false;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char letter = line[at];
    if (quote == 0 && (letter == ' ' || letter == '\t')) {
      if (begun) words.emplace_back();
      begun = false;
      continue;
    }
    begun = true;
    if (quote == 0 && (letter == '"' || letter == '\'')) {
      quote = letter;
    } else if (letter == quote) {
      quote = 0;
    } else if (letter == '\\' && quote != '\'' && at + 1 < line.size()) {
      words.back() += line[++at];
    } else {
      words.back() += letter;
    }
  }
  return words;
}

}  // namespace burnish
