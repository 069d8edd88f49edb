#pragma once
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "postproc/text/text_file.h"

namespace burnish {

struct Outcome {
  int code = 0;
  std::string out, err;
};

/// Runs a line of the shell in a directory, where stdout.txt and stderr.txt are left.
inline Outcome shell(const std::filesystem::path& dir, const std::string& line) {
  const int status =
      std::system(("cd " + dir.string() + " && { " + line + "; } > stdout.txt 2> stderr.txt").c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readText(dir / "stdout.txt"),
          readText(dir / "stderr.txt")};
}

}  // namespace burnish
