#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace burnish::inline core {

/// A row of a table as text, without its line break: cells between commas, in quotes where they must be.
std::string csvRow(const std::vector<std::string>& cells);

/// The cells of a row without the quotes around them, and without blanks around these; of a cell whose quotes are not closed
/// all that stands there.
std::vector<std::string> cellsOfRow(std::string_view row);

}  // namespace burnish::inline core
