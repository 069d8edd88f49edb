#pragma once
#include <filesystem>

#include "postproc/study/study.h"

namespace burnish {

/// Reads and checks a study and replaces its parameters; every run's scene is read once to see that it can be
/// used. Throws one `Error` with a line for everything that is wrong:
/// `FILE:LINE:COLUMN: key.path: what was found; what is allowed`.
Study readStudy(const std::filesystem::path& file);

}  // namespace burnish
