#include "engine/core/reading_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "engine/core/sanitized.h"

namespace burnish::inline core {
namespace {

using Clock = std::chrono::steady_clock;

/// What a reader may take for one answer: seconds, and bytes beyond what the program has.
constexpr int kMostSeconds = 60;
constexpr std::uint64_t kMostGigabytes = 4;

constexpr std::int64_t kAnswer = 1, kMistake = 2, kEnd = 3;

std::uint64_t bytesTaken() {
  std::uint64_t pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%lu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void setLimits() {
  const ::rlimit noCore{0, 0};
  ::setrlimit(RLIMIT_CORE, &noCore);
  ::rlimit memory{};
  if (kIsSanitized || ::getrlimit(RLIMIT_AS, &memory) != 0) return;
  memory.rlim_cur = std::min<::rlim_t>(memory.rlim_cur, bytesTaken() + (kMostGigabytes << 30U));
  ::setrlimit(RLIMIT_AS, &memory);
}

/// Reads and writes all bytes of a pipe, or ends the process: nobody is at its other end.
void readAll(int pipe, void* bytes, std::size_t count) {
  for (auto* at = static_cast<char*>(bytes); count > 0;) {
    const ::ssize_t done = ::read(pipe, at, count);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) ::_exit(0);
    at += done;
    count -= static_cast<std::size_t>(done);
  }
}
void writeAll(int pipe, const void* bytes, std::size_t count) {
  for (const auto* at = static_cast<const char*>(bytes); count > 0;) {
    const ::ssize_t done = ::write(pipe, at, count);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) ::_exit(0);
    at += done;
    count -= static_cast<std::size_t>(done);
  }
}

/// What else is thrown ends the process: it must not come to what the program was doing when it began.
[[noreturn]] void serve(const std::string& file, const ReadingProcess::Answer& answer, int questions,
                        int answers) noexcept {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGTERM, SIGHUP, SIGCHLD, SIGPIPE})
    std::signal(signal, SIG_DFL);
  std::signal(SIGINT, SIG_IGN);  // the program ends, and this process with it
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  ::setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);  // files are only read, perhaps while they are written
  setLimits();
  const TakeBytes take = [answers](const void* bytes, std::size_t count) { writeAll(answers, bytes, count); };
  const auto refuse = [&take](std::int64_t kind, const std::string& why) {
    send(kind, take);
    send(why, take);
  };
  for (;;) {
    std::int64_t question = 0;
    readAll(questions, &question, sizeof(question));
    ReadingProcess::Send made;
    try {
      made = answer(question);
    } catch (const std::bad_alloc&) {
      refuse(kEnd,
             fmt::format("{}: the file is damaged, or large: its reader needs more than {} GB of memory",
                         file, kMostGigabytes));
      ::_exit(0);
    } catch (const Error& error) {
      refuse(kMistake, error.what());
      continue;
    }
    send(kAnswer, take);
    made(take);
  }
}

Error cannotStart(const std::filesystem::path& file) {
  return Error(fmt::format("{}: no process could be started to read it", file.string()));
}

}  // namespace

ReadingProcess::ReadingProcess(std::filesystem::path file, const Answer& answer) : file_(std::move(file)) {
  std::array<int, 2> questions{}, answers{};
  if (::pipe2(questions.data(), O_CLOEXEC) != 0) throw cannotStart(file_);
  if (::pipe2(answers.data(), O_CLOEXEC) != 0) {
    for (const int end : questions) ::close(end);
    throw cannotStart(file_);
  }
  process_ = ::fork();
  if (process_ == 0) {
    ::close(questions[1]);
    ::close(answers[0]);
    serve(file_.string(), answer, questions[0], answers[1]);
  }
  ::close(questions[0]);
  ::close(answers[1]);
  questions_ = questions[1];
  answers_ = answers[0];
  if (process_ < 0) {
    stop();
    throw cannotStart(file_);
  }
}

ReadingProcess::~ReadingProcess() {
  stop();
}

void ReadingProcess::ask(std::int64_t question, const std::function<void(const FillBytes&)>& receive) {
  if (!end_.empty()) throw Error(end_);
  deadline_ = Clock::now() + std::chrono::seconds(kMostSeconds);
  if (::write(questions_, &question, sizeof(question)) != sizeof(question)) throw cannotStart(file_);
  const FillBytes fill = [this](void* bytes, std::size_t count) { fillWith(bytes, count); };
  const std::int64_t kind = receiveNumber(fill);
  if (kind == kEnd) endWith(receiveText(fill));
  if (kind != kAnswer) throw Error(receiveText(fill));
  receive(fill);
}

void ReadingProcess::fillWith(void* bytes, std::size_t count) {
  for (auto* at = static_cast<char*>(bytes); count > 0;) {
    throwIfInterrupted();
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now());
    ::pollfd waiting{answers_, POLLIN, 0};
    const int ready = left.count() > 0 ? ::poll(&waiting, 1, static_cast<int>(left.count())) : 0;
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) {
      stop();
      endWith(fmt::format("{}: the file is damaged, or large: its reader came to no end in {} seconds",
                          file_.string(), kMostSeconds));
    }
    const ::ssize_t done = ::read(answers_, at, count);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) {
      const int end = waitForEnd();
      endWith(fmt::format(
          "{} is damaged: its reader stopped {}", file_.string(),
          WIFSIGNALED(end) ? fmt::format("with signal {}", WTERMSIG(end)) : "without having read it"));
    }
    at += done;
    count -= static_cast<std::size_t>(done);
  }
}

void ReadingProcess::endWith(std::string why) {
  end_ = std::move(why);
  throw Error(end_);
}

void ReadingProcess::stop() {
  for (int* pipe : {&questions_, &answers_})
    if (*pipe >= 0) ::close(std::exchange(*pipe, -1));
  if (process_ > 0) ::kill(process_, SIGKILL);
  waitForEnd();
}

/// How the process ended, or 0 without one.
int ReadingProcess::waitForEnd() {
  int end = 0;
  while (process_ > 0 && ::waitpid(process_, &end, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return end;
}

}  // namespace burnish::inline core
