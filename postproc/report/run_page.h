#pragma once
#include <filesystem>

#include "postproc/report/report.h"
#include "postproc/text/page.h"

namespace burnish {

/// Title and body of the page of a run, which `html` will be: warnings, summary, settings, pictures with a slider over the frames,
/// charts, convergence and timings.
HtmlPage runPage(const std::filesystem::path& directory, const ReportOptions& options,
                 const std::filesystem::path& html);

}  // namespace burnish
