#include "postproc/report/report.h"

#include <fmt/format.h>

#include "engine/core/error.h"
#include "engine/results/result_files.h"
#include "postproc/report/report_texts.h"
#include "postproc/report/run_page.h"
#include "postproc/report/study_page.h"
#include "postproc/text/page.h"
#include "postproc/text/text_file.h"

namespace burnish {

void writeReport(const std::filesystem::path& directory, const ReportOptions& options,
                 const std::filesystem::path& html) {
  HtmlPage page;
  if (std::filesystem::exists(modelFile(directory)))
    page = runPage(directory, options, html);
  else if (options.turn)
    throw Error(
        fmt::format("--turn: {} is not the directory of a run, of which alone there is a page to turn",
                    directory.string()));
  else if (std::filesystem::is_directory(directory / "runs"))
    page = studyPage(directory, options);
  else
    throw Error(
        fmt::format("{}: found neither result.h5 nor runs/; expected the directory of a run or of a study",
                    directory.string()));
  page.style = kReportStyle;
  page.script = kReportScript;
  page.scriptHash = kReportScriptHash;
  writeText(htmlText(page), html);
}

}  // namespace burnish
