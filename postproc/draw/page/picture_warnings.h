#pragma once
#include <string>
#include <vector>

namespace burnish {

/// Keeps what is to be told of a picture that is drawn all the same. A text is kept once.
void noteWarning(const std::string& text);

/// What was noted since the last call.
std::vector<std::string> takeWarnings();

}  // namespace burnish
