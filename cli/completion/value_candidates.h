#pragma once
#include <vector>

#include "cli/completion/completion.h"
#include "cli/completion/given_line.h"

namespace burnish {

/// Values of `line.of` in the place of `line.word`; they need not begin with it. What an option's value is follows from the name of
/// its type, as help shows it: words in small letters stand for themselves, FILE.csv is a file with this ending, and for names such
/// as FIELD or DIR there is a row in a table.
std::vector<Candidate> valueCandidates(const CLI::App& program, const GivenLine& line);

}  // namespace burnish
