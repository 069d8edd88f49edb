#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands/chart_options.h"
#include "engine/results/result_reader.h"
#include "postproc/draw/chart/chart.h"

namespace burnish {

/// What `burnish probe` was asked for. Empty texts: not given.
struct ProbeArguments {
  std::vector<std::filesystem::path> results;
  std::string line, point, face, depth;  ///< one of them
  std::vector<std::string> fields;
  std::string frame;
  std::vector<std::string> bodies;
  std::string patch;
  bool mean = false;       ///< of all of a path, over time
  bool reference = false;  ///< the path lies in the undeformed body
  int points = 401;
  std::optional<double> window, length;  ///< length: of `depth`
  ChartArguments chart;
};

/// What a chart shows, and as a table.
struct ProbedChart {
  Chart chart;
  std::string table;  ///< CSV
};

/// results: one per path of the arguments. Throws `Error` for an option that does not fit the results or other
/// options.
ProbedChart probedChart(const ProbeArguments& arguments, const std::vector<ResultReader>& results);

}  // namespace burnish
