#include "engine/core/csv.h"

namespace burnish {
namespace {

std::string quotedCell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::string csvRow(const std::vector<std::string>& cells) {
  std::string row;
  for (std::size_t k = 0; k < cells.size(); ++k) row += (k == 0 ? "" : ",") + quotedCell(cells[k]);
  return row;
}

}  // namespace burnish
