#pragma once
#include <filesystem>
#include <vector>

#include "postproc/study/run_outlook.h"
#include "postproc/study/study.h"

namespace burnish {

/// Reads and checks a study and replaces its parameters; every run's scene is read once to see that it can be
/// used. Throws one `Error` with a line for everything that is wrong:
/// `FILE:LINE:COLUMN: key.path: what was found; what is allowed`.
Study readStudy(const std::filesystem::path& file);

/// Throws one `Error` of the same kind for all that figures and measures of a study, as `readStudy` has it, ask for that the
/// results of its runs will not have. outlooks: one for each run.
void requireOutlooks(const Study& study, const std::vector<RunOutlook>& outlooks);

}  // namespace burnish
