#pragma once
#include <filesystem>

#include "postproc/report/report.h"
#include "postproc/text/page.h"

namespace burnish {

/// Title and body of the page of a run, which `html` will be: warnings, summary, settings, pictures with a slider over the frames,
/// charts, convergence and timings. Writes the page to turn beside it if there is to be one.
HtmlPage runPage(const std::filesystem::path& directory, const ReportOptions& options,
                 const std::filesystem::path& html);

}  // namespace burnish
