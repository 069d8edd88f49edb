#pragma once
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace burnish {

/// Starts this very program with other arguments, without a shell. It reads nothing and prints into a file,
/// which is emptied before; the file's directory must exist. Throws `Error` if that fails.
pid_t startSelf(const std::vector<std::string>& arguments, const std::filesystem::path& log);

/// The status of a process as `waitpid` gives it once it has ended; nothing before.
std::optional<int> endOf(pid_t process);

/// What a signal does when it comes a second time.
enum class SecondSignal { Noted, Ends };

/// While it lives, SIGINT, SIGTERM and SIGHUP are noted instead of ending the program: work that can be left
/// throws `Interrupted` (see `throwIfInterrupted`), or looks here. One at a time.
class SignalGuard {
 public:
  explicit SignalGuard(SecondSignal second);
  ~SignalGuard();
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

  /// The last signal that came, or 0.
  int signal() const;
  /// How many came.
  int count() const;

 private:
  void set(int signal, void (*handler)(int), int flags);

  struct Saved;
  std::vector<Saved> saved_;
};

}  // namespace burnish
