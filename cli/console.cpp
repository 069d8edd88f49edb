#include "cli/console.h"
#include "cli/silence.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

#include "engine/core/error.h"

namespace burnish {
namespace {

int outputProblem = 0;  ///< the first errno of standard output
bool isSilent = false;
std::string kept;  ///< for standard error

void noteProblem(bool fine) {
  if (!fine && outputProblem == 0 && errno != EINTR) outputProblem = errno;
}

/// While it lives, writing to a pipe that nobody reads is an error of the call and does not end the program.
class NoBrokenPipe {
 public:
  NoBrokenPipe() {
    struct sigaction ignore = {};
    ignore.sa_handler = SIG_IGN;
    ::sigaction(SIGPIPE, &ignore, &before_);
  }
  ~NoBrokenPipe() { ::sigaction(SIGPIPE, &before_, nullptr); }
  NoBrokenPipe(const NoBrokenPipe&) = delete;
  NoBrokenPipe& operator=(const NoBrokenPipe&) = delete;

 private:
  struct sigaction before_ = {};
};

}  // namespace

void openStandardDescriptors() {
  // open() takes the lowest number that is free.
  for (int descriptor = ::open("/dev/null", O_RDWR); descriptor >= 0;
       descriptor = ::open("/dev/null", O_RDWR))
    if (descriptor > STDERR_FILENO) {
      ::close(descriptor);
      return;
    }
}

void keepSilent() {
  isSilent = true;
}

std::string endSilence() {
  isSilent = false;
  return std::exchange(kept, {});
}

void printText(std::string_view text) {
  if (isSilent) return;
  noteProblem(std::fwrite(text.data(), 1, text.size(), stdout) == text.size());
}

void printErrorText(std::string_view text) {
  if (isSilent) {
    kept += text;
    return;
  }
  flushOutput();
  const NoBrokenPipe guard;
  std::fwrite(text.data(), 1, text.size(), stderr);
}

std::size_t terminalColumns() {
  constexpr std::size_t usual = 80;
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

void flushOutput() {
  noteProblem(std::fflush(stdout) == 0);
}

void requirePrinted(GoneReader reader) {
  flushOutput();
  if (outputProblem == 0 || (outputProblem == EPIPE && reader == GoneReader::IsFine)) return;
  throw Error(
      fmt::format("cannot print on standard output: {}", std::generic_category().message(outputProblem)));
}

}  // namespace burnish
