#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace burnish::inline core {

/// A table that somebody has measured: CSV with a header. Lines that begin with # are passed over, blanks
/// around cells too.
class MeasuredTable {
 public:
  /// Throws `Error` with file and line for what is no such table.
  explicit MeasuredTable(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t numRows() const { return rows_.size(); }

  /// The number of the column that has the first of these names that there is, or nothing.
  std::optional<std::size_t> find(const std::vector<std::string>& names) const;

  /// The same. Throws `Error` that tells the columns that there are. meaning: what it would hold.
  std::size_t require(const std::vector<std::string>& names, const std::string& meaning) const;

  const std::string& text(std::size_t row, std::size_t column) const { return rows_[row].cells[column]; }

  /// Throws `Error` with the place unless the cell is a finite number.
  double number(std::size_t row, std::size_t column) const;

  /// "file.csv:12: column stress", to begin a message with.
  std::string place(std::size_t row, std::size_t column) const;

 private:
  struct Row {
    std::size_t line;
    std::vector<std::string> cells;
  };

  std::filesystem::path path_;
  std::vector<std::string> columns_;
  std::vector<Row> rows_;
};

}  // namespace burnish::inline core
