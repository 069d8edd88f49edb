#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/completion/completion.h"
#include "cli/console.h"

namespace burnish {
namespace {

struct CompleteArguments {
  std::string line;  ///< as bash has it
  std::vector<std::string> words;
};

/// bash takes a word to begin behind = and :, and wants the rest alone.
ExitCode completeLine(const CLI::App& program, const std::string& line) {
  std::vector<std::string> words = shellWords(line);
  words.erase(words.begin());
  if (words.empty()) return ExitCode::Fine;
  const std::size_t cut = words.back().find_last_of("=:") + 1;
  for (const Candidate& candidate : candidates(program, words))
    if (candidate.text.size() > cut) printOut("{}\n", candidate.text.substr(cut));
  return ExitCode::Fine;
}

ExitCode completeWords(const CLI::App& program, const std::vector<std::string>& words) {
  for (const auto& [text, about] : candidates(program, words)) printOut("{}\t{}\n", text, about);
  return ExitCode::Fine;
}

}  // namespace

/// What the completions of the shells call.
void addCompleteCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("complete", "Tell what can stand at the cursor")->group("");
  const auto arguments = std::make_shared<CompleteArguments>();
  CLI::Option* line = command->add_option("--line", arguments->line, "A line of bash up to the cursor");
  command->add_option("WORD", arguments->words,
                      "Words behind the name of the program; the last one is being written");
  command->callback([&action, &app, arguments, line] {
    action = [&app, arguments, line] {
      return line->count() > 0 ? completeLine(app, arguments->line) : completeWords(app, arguments->words);
    };
  });
}

}  // namespace burnish
