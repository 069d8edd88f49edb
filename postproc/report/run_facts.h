#pragma once
#include "postproc/report/html_parts.h"
#include "postproc/report/run_record.h"

namespace burnish {

/// How a run went, in a few lines; of one that has not ended, as far as that is known.
Facts runFacts(const RunRecord& run);

}  // namespace burnish
