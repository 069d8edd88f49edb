#pragma once
#include <optional>
#include <string>
#include <vector>

namespace burnish::inline core {

/// The candidate that a mistyped word most probably meant: fewest insertions, deletions, replacements and
/// swaps of neighbours, upper and lower case alike. Empty when nothing is close.
std::optional<std::string> nearest(const std::string& word, const std::vector<std::string>& candidates);

/// ` Did you mean "..."?` with a leading blank, or nothing.
std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace burnish::inline core
