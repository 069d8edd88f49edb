#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cli/commands/chart_options.h"
#include "cli/commands/probe_source.h"
#include "postproc/draw/chart/chart.h"

namespace burnish {

/// What `burnish probe` was asked for.
struct ProbeArguments {
  std::vector<std::filesystem::path> results;
  DeclaredOptions probe;  ///< of an `AnyProbeSpec`
  std::string frame;      ///< empty: not given
  std::string section;    ///< a plane instead of a path; empty: not given
  ChartArguments chart;
};

/// What a chart shows, and as a table.
struct ProbedChart {
  Chart chart;
  std::string table;  ///< CSV
};

/// What the profiles of `--depth`, or the sections, say as wholes, as CSV: a row for each result and frame. Throws `Error`
/// as `depthNumbers` and `sectionNumbers` do, for results of several units, and for a section beside another place.
std::string numbersTable(const ProbeArguments& arguments, const std::vector<ProbeSource>& results);

/// results: one per path of the arguments. Throws `Error` for an option that does not fit the results or other
/// options.
ProbedChart probedChart(const ProbeArguments& arguments, const std::vector<ProbeSource>& results);

}  // namespace burnish
