#include "cli/output_target.h"

#include <unistd.h>

#include <string>
#include <utility>

#include "cli/console.h"
#include "engine/core/error.h"
#include "postproc/text/text_file.h"

namespace burnish {

bool isStandardOutput(const std::filesystem::path& name) {
  return name == "-";
}

OutputTarget::OutputTarget(std::filesystem::path name, const char* ending) : file_(std::move(name)) {
  if (!isStandardOutput(file_)) return;
  if (::isatty(STDOUT_FILENO) != 0)
    throw Error(
        "-o: found \"-\", and standard output is a terminal, which shows no such files; send it to a file or a program");
  scratch_.emplace();
  file_ = scratch_->path() / (std::string("printed") + ending);
}

void OutputTarget::finish() const {
  if (scratch_) printText(readText(file_));
}

}  // namespace burnish
