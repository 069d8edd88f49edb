#include "engine/core/measured_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "engine/core/csv.h"
#include "engine/core/error.h"
#include "engine/core/quoted.h"

namespace burnish::inline core {
namespace {

constexpr std::uintmax_t kLargestFile = 64'000'000;

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

std::vector<std::string> trimmedCells(std::string_view line) {
  std::vector<std::string> cells = cellsOfRow(line);
  for (std::string& cell : cells) cell = std::string(trimmed(cell));
  return cells;
}

}  // namespace

MeasuredTable::MeasuredTable(const std::filesystem::path& path) : path_(path) {
  std::error_code status;
  std::ifstream file(path);
  if (!file || !std::filesystem::is_regular_file(path, status))
    throw Error(fmt::format(
        "{}: there is no such file, or it cannot be read; allowed: a CSV file with a header", path.string()));
  if (std::filesystem::file_size(path, status) > kLargestFile)
    throw Error(fmt::format("{}: larger than 64 MB; allowed: a table of measured points", path.string()));
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // of spreadsheets
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    std::vector<std::string> cells = trimmedCells(text);
    if (columns_.empty()) {
      columns_ = std::move(cells);
      continue;
    }
    if (cells.size() != columns_.size())
      throw Error(fmt::format("{}:{}: found {} cells under {} columns; allowed: one for each", path.string(),
                              number, cells.size(), columns_.size()));
    rows_.push_back({number, std::move(cells)});
  }
  if (rows_.empty())
    throw Error(fmt::format(
        "{}: holds no points; allowed: a header with the names of the columns and rows of numbers",
        path.string()));
}

std::optional<std::size_t> MeasuredTable::find(const std::vector<std::string>& names) const {
  for (const std::string& name : names)
    if (const auto found = std::ranges::find(columns_, name); found != columns_.end())
      return static_cast<std::size_t>(found - columns_.begin());
  return std::nullopt;
}

std::size_t MeasuredTable::require(const std::vector<std::string>& names, const std::string& meaning) const {
  if (const auto found = find(names)) return *found;
  std::vector<std::string> shown;
  for (const std::string& column : columns_) shown.push_back(shortened(column));
  throw Error(fmt::format("{}: there is no column {}, {}; its columns are {}", path_.string(),
                          fmt::join(names, " or "), meaning, fmt::join(shown, ", ")));
}

double MeasuredTable::number(std::size_t row, std::size_t column) const {
  const std::string& cell = text(row, column);
  double value = 0.0;
  const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (cell.empty() || error != std::errc() || stop != cell.data() + cell.size() || !std::isfinite(value))
    throw Error(fmt::format("{}: found {}; allowed: a number", place(row, column), quoted(cell)));
  return value;
}

std::string MeasuredTable::place(std::size_t row, std::size_t column) const {
  return fmt::format("{}:{}: column {}", path_.string(), rows_[row].line, columns_[column]);
}

}  // namespace burnish::inline core
