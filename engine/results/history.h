#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/fingerprint.h"
#include "engine/core/output_file.h"

namespace burnish::inline results {

/// How far a table had been written, and what was in it.
struct TableMark {
  std::uint64_t bytes = 0;
  std::string fingerprint;  ///< of these bytes
};

/// Writes a table of numbers as CSV with a header, every number in the shortest form that reads back exactly.
class HistoryWriter {
 public:
  /// Creates or empties the file. Throws `Error` if that fails or a column's name is empty, repeated, or has
  /// a comma, quote or line break in it.
  HistoryWriter(std::filesystem::path path, std::vector<std::string> columns);

  /// Goes on behind a mark. Throws `Error` if the file is shorter, its header another one, or what stands
  /// before the mark is not what was written.
  HistoryWriter(std::filesystem::path path, std::vector<std::string> columns, const TableMark& mark);

  /// Hands a row of one value per column to the system as a whole, so that readers and a killed run see whole
  /// rows. Throws `Error` if the file cannot be written.
  void append(const std::vector<double>& row);

  /// Returns how far the file goes, when all of it is on the disk.
  TableMark sync();

 private:
  void write(std::string line);

  std::vector<std::string> columns_;
  Fingerprint written_;
  OutputFile file_;
};

/// A history by columns, all of the same length.
struct HistoryTable {
  std::filesystem::path path;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> values;  ///< one list per column

  std::size_t numRows() const { return values.empty() ? 0 : values.front().size(); }

  /// Throws `Error` naming the columns that exist.
  const std::vector<double>& column(const std::string& name) const;
};

/// A column of a table, or null if it has none of that name.
const std::vector<double>* findColumn(const HistoryTable& table, const std::string& name);

/// Reads a history, or a table of another program, whose cells may stand in quotes, also while it is being written: of the tables of a run (history.csv, convergence.csv) a last row without
/// its line break is left out. Throws `Error` with file, line and column for anything that is not a number and for rows of
/// another length.
HistoryTable readHistory(const std::filesystem::path& path);

}  // namespace burnish::inline results
