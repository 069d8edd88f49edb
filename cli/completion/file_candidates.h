#pragma once
#include <string>
#include <vector>

#include "cli/completion/completion.h"

namespace burnish {

/// Files with these endings, such as .yaml, that a word which is being written may name, and the directories on the way. An empty
/// ending: every file.
std::vector<Candidate> fileCandidates(const std::string& word, const std::vector<std::string>& endings);

}  // namespace burnish
