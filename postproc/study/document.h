#pragma once
#include <filesystem>

#include "postproc/study/study.h"

namespace burnish {

struct DocumentOptions {
  std::filesystem::path file;  ///< Markdown
  std::filesystem::path
      gallery;  ///< the pictures shown are copied there; empty: they are shown where they are
};

/// Writes what came out of a study: which claims hold, a table of all runs, and each statement with its
/// table, verdicts and figures. Equal results give equal bytes. Throws `Error` for measures that results do
/// not have and files that cannot be written; runs and pictures that are missing are named in the document.
void writeDocument(const Study& study, const std::filesystem::path& studyDirectory,
                   const DocumentOptions& options);

}  // namespace burnish
