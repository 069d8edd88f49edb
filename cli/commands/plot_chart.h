#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cli/commands/chart_options.h"
#include "postproc/draw/chart/chart.h"
#include "postproc/draw/chart/chart_difference.h"

namespace burnish {

/// What `burnish plot` draws. Empty texts: not given.
struct PlotArguments {
  std::vector<std::filesystem::path> histories;  ///< directories of runs or CSV files
  std::string x = "time";
  std::vector<std::string> y{"strain_energy"}, y2;  ///< y2: along the axis at the right
  std::string where;
  std::filesystem::path reference;
  std::string difference = "absolute";
  ChartArguments chart;
  std::string y2Title, y2Range;
};

/// DIR/history.csv for the directory of a run, else the file itself.
std::filesystem::path historyFile(const std::filesystem::path& path);

/// The largest difference of a run from the reference.
struct LargestDifference {
  std::string run, y;
  CurveDifference found;
};

struct PlottedChart {
  Chart chart;                                 ///< curves are called by their formulas, as data are
  std::vector<std::string> legend;             ///< what curves are called in the picture, in words
  std::vector<LargestDifference> differences;  ///< with a reference
};

/// Reads the histories. Throws `Error` for an option that does not fit, and for histories, formulas and data
/// that cannot be used.
PlottedChart chartOf(const PlotArguments& arguments);

}  // namespace burnish
