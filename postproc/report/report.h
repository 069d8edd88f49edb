#pragma once
#include <filesystem>

#include "postproc/draw/contour/picture_options.h"

namespace burnish {

struct ReportOptions {
  PanelOptions picture;            ///< without a field: plastic strain, or else the von Mises stress
  int frames = 40;                 ///< at most so many pictures of a run, >= 2, evenly chosen
  bool turn = false;               ///< of a run: with a page to turn in it, see `viewPage`
  std::filesystem::path document;  ///< of a study; empty: the only Markdown file in its directory, if any
};

/// Writes a page about a run or a study, which needs nothing else: no network, no other file. directory: of a
/// run (with result.h5, which may still be going on) or of a study (with runs/). Throws `Error` for other
/// directories, results that cannot be read, an unknown field, a page to turn of a study, and a page that cannot be
/// written.
void writeReport(const std::filesystem::path& directory, const ReportOptions& options,
                 const std::filesystem::path& html);

}  // namespace burnish
