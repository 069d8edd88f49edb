#pragma once
#include <filesystem>
#include <string>

#include "postproc/study/study.h"

namespace burnish {

struct SnakefileOptions {
  std::filesystem::path file;      ///< that is written
  std::filesystem::path results;   ///< the study's directory; empty: out/NAME of the study
  std::filesystem::path document;  ///< Markdown; empty: NAME of the study.md among the results
  std::filesystem::path gallery;   ///< see `DocumentOptions`
};

/// A study as a workflow of Snakemake: every run, every figure and the document are rules, which call this
/// program as `burnish figures` does. Relative paths are those of the directory in which it is written, where
/// Snakemake is to be started. Throws `Error` for names of files that Snakemake cannot work with.
std::string snakefileText(const Study& study, const SnakefileOptions& options);

/// How Snakemake is started with this file.
std::string snakemakeCommand(const std::filesystem::path& file);

/// Writes it. Throws `Error` if that cannot be done, or if a file stands there that is no such workflow.
void writeSnakefile(const Study& study, const SnakefileOptions& options);

}  // namespace burnish
