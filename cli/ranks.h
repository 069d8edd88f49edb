#pragma once
#include <string>

#include "cli/command.h"
#include "engine/core/team.h"

/// The program as one of several processes, the ranks, which mpirun has started together.
namespace burnish {

/// Those that this process is one of; alone before `joinRanks` and without others.
const Team& ranks();

/// Makes this process one of the ranks that were started, if there are several. From here on only the first one
/// prints. command: the first word of the arguments. Throws `Error` if the command is none that ranks do together,
/// or if they do not find each other.
void joinRanks(const std::string& command);

/// To be called at the end of the program: returns the exit code when all ranks have come here. A rank that has
/// failed alone ends them all.
ExitCode leaveRanks(ExitCode code);

}  // namespace burnish
