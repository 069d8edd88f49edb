#pragma once
#include <string>
#include <vector>

#include "postproc/report/run_record.h"

namespace burnish {

/// A sentence for everything that makes a run doubtful: it has not come to its end; steps ended above a
/// tolerance; what the run itself warned of and doubted. Of a run without an end the history tells: the body
/// is penetrated beyond the limits of `Condition::Penetration`, on the mesh of that time, or the volume ratio
/// J falls below that of `Condition::SmallJ`.
std::vector<std::string> runWarnings(const RunRecord& run);

}  // namespace burnish
