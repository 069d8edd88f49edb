#pragma once
#include <string>
#include <vector>

#include "engine/analysis/run.h"

namespace burnish {

/// What a run says at its end, a few lines with line breaks.
std::string summaryText(const RunSummary& summary);

/// One sentence for everything that makes the results doubtful.
std::vector<std::string> warnings(const RunSummary& summary);

/// Seconds by part of the program.
std::string timingsText(const RunSummary& summary);

}  // namespace burnish
