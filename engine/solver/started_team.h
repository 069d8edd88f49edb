#pragma once
#include "engine/core/team.h"

namespace burnish::inline solver {

/// How many processes mpirun, or srun with PMIx, has started together with this one, itself counted, and which
/// of them this is: as their environment says. 1 and 0 without.
int numStarted();
int rankStarted();

/// The team of these processes. Its library is loaded and MPI begun by the first call, and ended with the
/// process. Throws `Error` if the library is not there, or if MPI is another one than that which has started them.
const Team& startedTeam();

}  // namespace burnish::inline solver
