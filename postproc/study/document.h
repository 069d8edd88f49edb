#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "postproc/study/study.h"

namespace burnish {

struct DocumentOptions {
  std::filesystem::path file;  ///< Markdown
  std::filesystem::path
      gallery;  ///< the pictures shown are copied there; empty: they are shown where they are
};

/// Writes what came out of a study: which claims hold, a table of all runs, and each statement with its
/// table, verdicts and figures. Equal results give equal bytes. Throws `Error` for files that cannot be written; runs and pictures
/// that are missing are named in the document, and so are measures that results do not have: these are returned, each
/// with the study, its name and what is wrong.
std::vector<std::string> writeDocument(const Study& study, const std::filesystem::path& studyDirectory,
                                       const DocumentOptions& options);

}  // namespace burnish
