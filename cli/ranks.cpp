#include "cli/ranks.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <thread>

#include "cli/console.h"
#include "cli/silence.h"
#include "engine/core/error.h"
#include "engine/solver/started_team.h"

namespace burnish {
namespace {

const Team* joined = nullptr;

}  // namespace

const Team& ranks() {
  return joined != nullptr ? *joined : alone();
}

void joinRanks(const std::string& command) {
  if (numStarted() == 1) return;
  if (rankStarted() > 0) keepSilent();
  joined = &startedTeam();
  if (command != "run")
    throw Error(fmt::format(
        "{} is not done by several processes together; start it without mpirun, it starts processes itself",
        command));
}

ExitCode leaveRanks(ExitCode code) {
  if (ranks().isAlone()) {
    // Who has started the others ends them with the first that fails; the rank that prints shall have printed.
    if (rankStarted() > 0) std::this_thread::sleep_for(std::chrono::seconds(1));
    return code;
  }
  const bool hasFailed = code != ExitCode::Fine;
  const std::optional<bool> firstHasFailed = ranks().meet(hasFailed);
  if (hasFailed && !ranks().isFirst() && !firstHasFailed.value_or(false))
    printError("rank {}: {}", ranks().rank(), endSilence());
  if (!firstHasFailed) ranks().abort(static_cast<int>(code));
  return code;
}

}  // namespace burnish
