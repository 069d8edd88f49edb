#include "postproc/draw/page/doubt_mark.h"

#include "engine/core/error.h"
#include "engine/results/summary_file.h"

namespace burnish {

std::string doubtMarkOf(const std::filesystem::path& runDirectory) {
  try {
    return readSummary(runDirectory).doubts.empty() ? "" : kDoubtMark;
  } catch (const Error&) {
    return "";  // the run goes on, or its summary is damaged: `burnish info` says so
  }
}

}  // namespace burnish
