#include "engine/results/history.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <sstream>
#include <string_view>
#include <utility>

#include "engine/core/csv.h"
#include "engine/core/error.h"

namespace burnish::inline results {
namespace {

/// Of a table that is read: names in quotes may have commas.
void checkNames(const std::vector<std::string>& columns, const std::filesystem::path& path) {
  for (auto name = columns.begin(); name != columns.end(); ++name) {
    if (name->empty())
      throw Error(fmt::format("{}: column {} has no name; expected one for each", path.string(),
                              name - columns.begin() + 1));
    if (std::find(columns.begin(), name, *name) != name)
      throw Error(fmt::format("{}: the column \"{}\" stands twice", path.string(), *name));
  }
}

/// Of a table that is written.
void checkColumns(const std::vector<std::string>& columns, const std::filesystem::path& path) {
  if (columns.empty()) throw Error(fmt::format("{}: a history needs at least one column", path.string()));
  for (const std::string& name : columns)
    if (name.empty() || name.find_first_of(",\"\r\n") != std::string::npos)
      throw Error(
          fmt::format("{}: \"{}\" cannot be the name of a column; leave out commas, quotes and line breaks",
                      path.string(), name));
  checkNames(columns, path);
}

/// Throws if there is a file with other columns; what is missing is found out when it is opened.
void requireColumns(const std::filesystem::path& path, const std::vector<std::string>& columns) {
  std::ifstream file(path);
  std::string header;
  const bool isWhole = std::getline(file, header) && !file.eof();
  if (isWhole && header != csvRow(columns))
    throw Error(fmt::format("{}: its columns are not those of the run that is to be resumed", path.string()));
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

std::string readAll(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream contents;
  if (!file || std::filesystem::is_directory(path))
    throw Error(fmt::format("{}: there is no such file, or it cannot be read", path.string()));
  if (!std::filesystem::is_regular_file(path) && !std::filesystem::is_fifo(path))
    throw Error(fmt::format("{}: this is no regular file; allowed: a table of numbers", path.string()));
  if (file.peek() != std::ifstream::traits_type::eof()) contents << file.rdbuf();
  return contents.str();
}

/// Whether a run writes the table, perhaps just now.
bool isOfRun(const std::filesystem::path& path) {
  return path.filename() == "history.csv" || path.filename() == "convergence.csv";
}

/// Of what the table holds before the mark. Throws if that is not what was written; what is missing is found
/// out when the file is opened.
Fingerprint fingerprintBefore(const TableMark& mark, const std::filesystem::path& path) {
  Fingerprint found;
  std::error_code unreadable;
  const std::uintmax_t size = std::filesystem::file_size(path, unreadable);
  if (unreadable || size < mark.bytes) return found;
  const std::string contents = readAll(path).substr(0, mark.bytes);
  found.add(std::as_bytes(std::span(contents)));
  if (found.text() != mark.fingerprint)
    throw Error(
        fmt::format("{} is not as the run wrote it: something in its first {} bytes was changed; bring it "
                    "back, or compute the scene again",
                    path.string(), mark.bytes));
  return found;
}

}  // namespace

HistoryWriter::HistoryWriter(std::filesystem::path path, std::vector<std::string> columns)
    : columns_((checkColumns(columns, path), std::move(columns))), file_(std::move(path)) {
  write(csvRow(columns_));
}

HistoryWriter::HistoryWriter(std::filesystem::path path, std::vector<std::string> columns,
                             const TableMark& mark)
    : columns_((requireColumns(path, columns), std::move(columns))),
      written_(fingerprintBefore(mark, path)),
      file_(std::move(path), mark.bytes) {}

void HistoryWriter::write(std::string line) {
  line += '\n';
  const auto bytes = std::as_bytes(std::span(line));
  file_.write(bytes);
  written_.add(bytes);
}

TableMark HistoryWriter::sync() {
  file_.sync();
  return {file_.size(), written_.text()};
}

void HistoryWriter::append(const std::vector<double>& row) {
  if (row.size() != columns_.size())
    throw std::invalid_argument(
        fmt::format("a row of {} values for {} columns", row.size(), columns_.size()));
  std::vector<std::string> cells;
  for (const double value : row) {
    std::array<char, 32> text;
    cells.emplace_back(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
  }
  write(csvRow(cells));
}

const std::vector<double>& HistoryTable::column(const std::string& name) const {
  if (const auto* found = findColumn(*this, name)) return *found;
  throw Error(fmt::format("{}: there is no column \"{}\"; its columns are {}", path.string(), name,
                          fmt::join(columns, ", ")));
}

const std::vector<double>* findColumn(const HistoryTable& table, const std::string& name) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), name);
  return found == table.columns.end()
             ? nullptr
             : &table.values[static_cast<std::size_t>(found - table.columns.begin())];
}

HistoryTable readHistory(const std::filesystem::path& path) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // spreadsheets begin UTF-8 with it
  const std::string contents = readAll(path);
  std::string_view rest = contents;
  if (rest.starts_with(kByteOrderMark)) rest.remove_prefix(kByteOrderMark.size());
  HistoryTable table{.path = path, .columns = {}, .values = {}};
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view text = rest.substr(0, end);
    const bool isOpen = end == rest.size();
    if (isOpen && (isOfRun(path) || text.find_first_not_of(" \t\r") == std::string_view::npos)) break;
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (text.ends_with('\r')) text.remove_suffix(1);
    const bool hasQuotes = text.find('"') != std::string_view::npos;
    const std::vector<std::string> unquoted = hasQuotes ? cellsOfRow(text) : std::vector<std::string>();
    const std::vector<std::string_view> cells =
        hasQuotes ? std::vector<std::string_view>(unquoted.begin(), unquoted.end()) : split(text);
    if (line == 1) {
      table.columns.assign(cells.begin(), cells.end());
      checkNames(table.columns, path);
      table.values.resize(table.columns.size());
      continue;
    }
    if (cells.size() != table.columns.size())
      throw Error(fmt::format("{}:{}: {} values instead of {}", path.string(), line, cells.size(),
                              table.columns.size()));
    for (std::size_t c = 0; c < cells.size(); ++c) {
      double value = 0.0;
      const auto [stop, error] = std::from_chars(cells[c].data(), cells[c].data() + cells[c].size(), value);
      if (error != std::errc() || stop != cells[c].data() + cells[c].size())
        throw Error(fmt::format("{}:{}: \"{}\" in the column {} is not a number", path.string(), line,
                                cells[c], table.columns[c]));
      table.values[c].push_back(value);
    }
  }
  if (table.columns.empty())
    throw Error(fmt::format("{} is empty where a header was expected", path.string()));
  return table;
}

}  // namespace burnish::inline results
