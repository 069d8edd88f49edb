#include "engine/solver/started_team.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "engine/core/error.h"
#include "engine/solver/petsc_module.h"

namespace burnish::inline solver {
namespace {

/// Where who starts processes together says how many they are, and which of them one is.
struct Starter {
  const char* size;
  const char* rank;
};

/// Open MPI, others with PMI, Slurm with PMIx.
constexpr std::array kStarters{
    Starter{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
    Starter{"PMI_SIZE", "PMI_RANK"},
    Starter{"SLURM_STEP_NUM_TASKS", "PMIX_RANK"},
};

/// Null if there is none.
const Starter* starter() {
  for (const Starter& one : kStarters)
    if (std::getenv(one.size) != nullptr && std::getenv(one.rank) != nullptr) return &one;
  return nullptr;
}

}  // namespace

int numStarted() {
  const Starter* one = starter();
  return one != nullptr ? std::max(1, std::atoi(std::getenv(one->size))) : 1;
}

int rankStarted() {
  const Starter* one = starter();
  return one != nullptr ? std::atoi(std::getenv(one->rank)) : 0;
}

const Team& startedTeam() {
  using Maker = const Team*();
  if (numStarted() == 1) return alone();
  static auto* const make =
      reinterpret_cast<Maker*>(petscFunction("burnishTeam", "a run of several processes"));
  const Team& team = *make();
  if (team.size() != numStarted())
    throw Error(fmt::format(
        "{} processes were started together, and MPI knows of {}; start them by the mpirun of Open MPI, or by "
        "srun --mpi=pmix",
        numStarted(), team.size()));
  return team;
}

}  // namespace burnish::inline solver
