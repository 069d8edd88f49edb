#include "engine/core/csv.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace burnish::inline core {
namespace {

std::string quotedCell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// What stands in quotes at the beginning of a text, with how far it goes; nothing if a comma or the end is not next.
struct QuotedCell {
  std::string text;
  std::size_t end = std::string_view::npos;  ///< of the comma behind it, or of the row
};
std::optional<QuotedCell> quotedCellIn(std::string_view row) {
  const std::size_t open = row.find_first_not_of(" \t");
  if (open == std::string_view::npos || row[open] != '"') return std::nullopt;
  QuotedCell cell;
  for (std::size_t k = open + 1; k < row.size(); ++k) {
    if (row[k] != '"') {
      cell.text += row[k];
    } else if (row.substr(k + 1).starts_with('"')) {
      cell.text += row[k++];
    } else {
      cell.end = std::min(row.find_first_not_of(" \t", k + 1), row.size());
      return cell.end == row.size() || row[cell.end] == ',' ? std::optional(cell) : std::nullopt;
    }
  }
  return std::nullopt;
}

}  // namespace

std::string csvRow(const std::vector<std::string>& cells) {
  std::string row;
  for (std::size_t k = 0; k < cells.size(); ++k) row += (k == 0 ? "" : ",") + quotedCell(cells[k]);
  return row;
}

std::vector<std::string> cellsOfRow(std::string_view row) {
  std::vector<std::string> cells;
  while (true) {
    std::size_t end = std::min(row.find(','), row.size());
    if (std::optional<QuotedCell> cell = quotedCellIn(row)) {
      end = cell->end;
      cells.push_back(std::move(cell->text));
    } else {
      cells.emplace_back(row.substr(0, end));
    }
    if (end == row.size()) return cells;
    row.remove_prefix(end + 1);
  }
}

}  // namespace burnish::inline core
