#include "cli/jobs/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "engine/core/error.h"
#include "engine/core/interruption.h"

namespace burnish {
namespace {

void note(int signal) {
  noteInterruption(signal);
}

}  // namespace

pid_t startSelf(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  std::vector<char*> argv{const_cast<char*>("burnish")};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  pid_t process = 0;
  const int status = posix_spawn(&process, "/proc/self/exe", &files, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (status != 0)
    throw Error(
        fmt::format("cannot start a process that prints to {}: {}", log.string(), std::strerror(status)));
  return process;
}

std::optional<int> endOf(pid_t process) {
  int status = 0;
  const pid_t ended = ::waitpid(process, &status, WNOHANG);
  if (ended == process) return status;
  constexpr int kUnknown = 1 << 8;  // as exit code 1: somebody else has taken the child's end
  if (ended < 0 && errno == ECHILD) return kUnknown;
  return std::nullopt;
}

struct SignalGuard::Saved {
  int signal;
  struct sigaction action;
};

SignalGuard::SignalGuard(SecondSignal second) {
  forgetInterruptions();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction current = {};
    ::sigaction(signal, nullptr, &current);
    if (current.sa_handler != SIG_IGN)  // else as nohup and shells want it
      set(signal, note, second == SecondSignal::Ends ? static_cast<int>(SA_RESETHAND | SA_RESTART) : 0);
  }
  set(SIGCHLD, SIG_DFL, 0);  // else children end without leaving how
}

void SignalGuard::set(int signal, void (*handler)(int), int flags) {
  Saved saved{signal, {}};
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  ::sigaction(signal, &action, &saved.action);
  saved_.push_back(saved);
}

SignalGuard::~SignalGuard() {
  for (const Saved& saved : saved_) ::sigaction(saved.signal, &saved.action, nullptr);
}

int SignalGuard::signal() const {
  return interruption();
}

int SignalGuard::count() const {
  return numInterruptions();
}

}  // namespace burnish
