#include "cli/faults.h"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

#include "cli/console.h"
#include "engine/core/error.h"
#include "engine/core/interruption.h"

namespace burnish {
namespace {

constexpr const char* kLittleMemory =
    "burnish: the memory of this machine, or that which is allowed (ulimit -v), does not suffice; take fewer "
    "basis functions, a lower degree or smaller pictures\n";

}  // namespace

ExitCode guarded(const Action& action) {
  try {
    return action();
  } catch (const Error& error) {
    printError("burnish: {}\n", error.what());
    return ExitCode::BadInput;
  } catch (const Interrupted&) {
    printError("burnish: interrupted by a signal; what was finished before is kept\n");
    return codeOfSignal(interruption());
  } catch (const std::bad_alloc&) {
    printErrorText(kLittleMemory);
    return ExitCode::BadInput;
  } catch (const std::exception& error) {
    printError("burnish: internal error: {}; this is a fault of the program, please report it\n",
               error.what());
  }
  return ExitCode::Internal;
}

ExitCode codeOfSignal(int signal) {
  return signal == SIGINT ? ExitCode::Interrupted : ExitCode::Terminated;
}

void endAtOnce() {
  try {
    if (std::current_exception()) std::rethrow_exception(std::current_exception());
  } catch (const std::bad_alloc&) {
    [[maybe_unused]] const ssize_t written =
        ::write(STDERR_FILENO, kLittleMemory, std::strlen(kLittleMemory));
    ::_exit(static_cast<int>(ExitCode::BadInput));
  } catch (...) {
  }
  std::abort();
}

}  // namespace burnish
