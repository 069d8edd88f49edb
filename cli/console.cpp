#include "cli/console.h"
#include "cli/silence.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
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

/// See no-color.org.
bool showsColours(int descriptor) {
  const char *none = std::getenv("NO_COLOR"), *terminal = std::getenv("TERM");
  return ::isatty(descriptor) != 0 && (none == nullptr || *none == '\0') && terminal != nullptr &&
         std::string_view(terminal) != "dumb";
}

std::string inColour(Tone tone, std::string_view word) {
  constexpr std::array kColours{32, 33, 31};  // green, yellow, red
  return fmt::format("\x1b[{}m{}\x1b[0m", kColours[static_cast<std::size_t>(tone)], word);
}

/// With the words that begin its messages in colours.
std::string withColours(std::string_view text) {
  std::string coloured;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    std::string_view line = text.substr(begin, end - begin);
    for (const auto& [word, tone] : {std::pair{"burnish:", Tone::Bad}, std::pair{"warning:", Tone::Doubtful}})
      if (line.starts_with(word)) {
        coloured += inColour(tone, word);
        line.remove_prefix(std::string_view(word).size());
        break;
      }
    coloured += line;
    begin = end;
  }
  return coloured;
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

std::string toned(Tone tone, const std::string& word) {
  return showsColours(STDOUT_FILENO) ? inColour(tone, word) : word;
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
  const std::string shown = showsColours(STDERR_FILENO) ? withColours(text) : std::string(text);
  std::fwrite(shown.data(), 1, shown.size(), stderr);
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
