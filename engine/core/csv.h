#pragma once
#include <string>
#include <vector>

namespace burnish {

/// A row of a table as text, without its line break: cells between commas, in quotes where they must be.
std::string csvRow(const std::vector<std::string>& cells);

}  // namespace burnish
