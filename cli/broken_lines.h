#pragma once
#include <cstddef>
#include <string>
#include <string_view>

/// Lines that end where the terminal ends, so that it does not break them within a word.
namespace burnish {

/// Letters that a line on standard output may have: columns of the terminal, or no limit if it is none.
std::size_t lineColumns();

/// A line, broken between words where it is longer; what follows is indented. A word that is longer by itself is left whole.
std::string brokenLine(std::string_view line, std::size_t indent, std::size_t columns);

/// Every line of a text for standard output; what follows is indented by two more than the line.
std::string brokenText(std::string_view text);

}  // namespace burnish
