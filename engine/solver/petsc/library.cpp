#include "engine/solver/petsc/library.h"

#include <signal.h>

#include <array>
#include <string>

#include "engine/core/error.h"

namespace burnish::inline solver::petsc {
namespace {

/// Gives the signals that end a run back to who had them: PETSc takes SIGTERM, and leaves it to the system when its handlers are
/// taken off.
class KeptSignals {
 public:
  KeptSignals() {
    for (std::size_t k = 0; k < kSignals.size(); ++k) ::sigaction(kSignals[k], nullptr, &actions_[k]);
  }
  ~KeptSignals() {
    for (std::size_t k = 0; k < kSignals.size(); ++k) ::sigaction(kSignals[k], &actions_[k], nullptr);
  }
  KeptSignals(const KeptSignals&) = delete;
  KeptSignals& operator=(const KeptSignals&) = delete;

 private:
  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, kSignals.size()> actions_{};
};

struct Library {
  Library() {
    const KeptSignals kept;
    if (PetscInitializeNoArguments() != 0) throw Error("PETSc does not start");
    // What goes wrong is said by the program, and signals are its own.
    PetscPopSignalHandler();
    PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  }
  ~Library() { PetscFinalize(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

}  // namespace

void begin() {
  static const Library library;
}

void check(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  char* where = nullptr;
  PetscErrorMessage(code, &text, &where);
  const std::string words = std::string("PETSc: ") + (text != nullptr ? text : "unknown error");
  int ranks = 1;
  MPI_Comm_size(PETSC_COMM_WORLD, &ranks);
  if (ranks > 1) throw Error(words);
  throw RunError(words);
}

}  // namespace burnish::inline solver::petsc
