#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace burnish {

/// What can stand at the cursor.
struct Candidate {
  std::string text;   ///< the whole word; more follows behind /, = and .
  std::string about;  ///< a few words, or nothing
};

/// What can stand in the place of the last word of a command line, which may be empty or half written. words: those behind the
/// name of the program. Never throws for what cannot be read: then there is nothing to propose.
std::vector<Candidate> candidates(const CLI::App& program, const std::vector<std::string>& words);

/// The words of a line as a shell sees them, without quotes; the last one is that at its end, which may be empty.
std::vector<std::string> shellWords(const std::string& line);

}  // namespace burnish
