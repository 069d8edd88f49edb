#pragma once
#include <string>
#include <vector>

#include "postproc/draw/chart/chart.h"
#include "postproc/report/run_record.h"

namespace burnish {

struct CaptionedChart {
  std::string caption;
  Chart chart;
};

/// Force on each tool and, where the history lists them, each support; energies and work, plastic strain,
/// penetration and volume ratio over time, as far as the history has them and they are not zero throughout.
std::vector<CaptionedChart> stateCharts(const RunRecord& run);

/// Iterations and size of each step, residuals at the end of each step and of the steps that took most.
std::vector<CaptionedChart> convergenceCharts(const RunRecord& run);

}  // namespace burnish
