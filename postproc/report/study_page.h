#pragma once
#include <filesystem>

#include "postproc/report/report.h"
#include "postproc/text/page.h"

namespace burnish {

/// Title and body of the page of a study: its runs in a table, its document with verdicts and figures, the
/// figures that the document does not show, and a section for each run.
HtmlPage studyPage(const std::filesystem::path& directory, const ReportOptions& options);

}  // namespace burnish
