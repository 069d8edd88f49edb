#pragma once
#include "cli/command.h"

/// How commands end that do not come to their end.
namespace burnish {

/// The exit code of an action; what it throws is told on standard error.
ExitCode guarded(const Action& action);

/// The exit code of a command that a signal has ended.
ExitCode codeOfSignal(int signal);

/// For std::set_terminate: ends the program where no handler is, in threads and destructors. Memory is all
/// that can be missing there; anything else aborts.
[[noreturn]] void endAtOnce();

}  // namespace burnish
