#include "postproc/foreign/foreign_file.h"

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
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "postproc/foreign/grid_stream.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// What a reader may take for one answer: seconds, and bytes beyond what the program has.
constexpr int kMostSeconds = 60;
constexpr std::uint64_t kMostGigabytes = 4;

constexpr std::int64_t kAnswer = 1, kMistake = 2;

/// Sanitizers reserve more addresses than any limit.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimitsMemory = false;
#else
constexpr bool kLimitsMemory = true;
#endif

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
  if (!kLimitsMemory || ::getrlimit(RLIMIT_AS, &memory) != 0) return;
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

/// The process that reads: opens the file and tells its times, then answers for one instant after the other
/// until nobody asks any more.
[[noreturn]] void serve(const fs::path& file, int questions, int answers) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGTERM, SIGHUP, SIGCHLD, SIGPIPE})
    std::signal(signal, SIG_DFL);
  std::signal(SIGINT, SIG_IGN);  // the program ends, and this process with it
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  ::setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);  // files are only read, perhaps while they are written
  setLimits();
  const TakeBytes take = [answers](const void* bytes, std::size_t count) { writeAll(answers, bytes, count); };
  const auto answer = [&](const auto& make) {
    try {
      const auto made = make();
      send(kAnswer, take);
      send(made, take);
    } catch (const std::bad_alloc&) {
      send(kMistake, take);
      send(fmt::format("{}: the file is damaged, or large: its reader needs more than {} GB of memory",
                       file.string(), kMostGigabytes),
           take);
      ::_exit(0);
    } catch (const Error& error) {
      send(kMistake, take);
      send(std::string(error.what()), take);
      ::_exit(0);
    }
  };
  std::unique_ptr<ForeignSource> source;
  answer([&] {
    source = openForeign(file);
    return source->times();
  });
  for (;;) {
    std::int64_t instant = 0;
    readAll(questions, &instant, sizeof(instant));
    answer([&] { return source->blocks(static_cast<std::size_t>(instant)); });
  }
}

}  // namespace

class ForeignFile::Reader {
 public:
  explicit Reader(fs::path file) : file_(std::move(file)) {
    start();
    times_ = ask<std::vector<double>>(std::nullopt, receiveNumbers);
  }
  ~Reader() { stop(); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  const fs::path& file() const { return file_; }
  const std::vector<double>& times() const { return times_; }

  const std::vector<ForeignBlock>& blocks(std::size_t instant) {
    if (instant != last_) {
      last_.reset();
      blocks_ = ask<std::vector<ForeignBlock>>(static_cast<std::int64_t>(instant), receiveBlocks);
      last_ = instant;
    }
    return blocks_;
  }

 private:
  void start() {
    loadReaders();  // once for all processes
    std::array<int, 2> questions{}, answers{};
    if (::pipe2(questions.data(), O_CLOEXEC) != 0) throw cannotStart();
    if (::pipe2(answers.data(), O_CLOEXEC) != 0) {
      for (const int end : questions) ::close(end);
      throw cannotStart();
    }
    process_ = ::fork();
    if (process_ == 0) {
      ::close(questions[1]);
      ::close(answers[0]);
      serve(file_, questions[0], answers[1]);
    }
    ::close(questions[0]);
    ::close(answers[1]);
    questions_ = questions[1];
    answers_ = answers[0];
    if (process_ < 0) {
      stop();
      throw cannotStart();
    }
  }

  Error cannotStart() const {
    return Error(fmt::format("{}: no process could be started to read it", file_.string()));
  }

  template <class Answer>
  Answer ask(std::optional<std::int64_t> instant, Answer (*receive)(const FillBytes&)) {
    deadline_ = Clock::now() + std::chrono::seconds(kMostSeconds);
    if (instant && ::write(questions_, &*instant, sizeof(*instant)) != sizeof(*instant)) throw stopped();
    const FillBytes fill = [this](void* bytes, std::size_t count) { fillWith(bytes, count); };
    if (receiveNumber(fill) == kAnswer) return receive(fill);
    throw Error(receiveText(fill));
  }

  void fillWith(void* bytes, std::size_t count) {
    for (auto* at = static_cast<char*>(bytes); count > 0;) {
      throwIfInterrupted();
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now());
      ::pollfd waiting{answers_, POLLIN, 0};
      const int ready = left.count() > 0 ? ::poll(&waiting, 1, static_cast<int>(left.count())) : 0;
      if (ready < 0 && errno == EINTR) continue;
      if (ready == 0) {
        stop();
        throw Error(fmt::format("{}: the file is damaged, or large: its reader came to no end in {} seconds",
                                file_.string(), kMostSeconds));
      }
      const ::ssize_t done = ::read(answers_, at, count);
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) throw stopped();
      at += done;
      count -= static_cast<std::size_t>(done);
    }
  }

  /// The process has gone.
  Error stopped() {
    const int end = waitForEnd();
    return Error(fmt::format(
        "{} is damaged: its reader stopped {}", file_.string(),
        WIFSIGNALED(end) ? fmt::format("with signal {}", WTERMSIG(end)) : "without having read it"));
  }

  void stop() {
    for (int* pipe : {&questions_, &answers_})
      if (*pipe >= 0) ::close(std::exchange(*pipe, -1));
    if (process_ > 0) ::kill(process_, SIGKILL);
    waitForEnd();
  }

  /// How the process ended, or 0 without one.
  int waitForEnd() {
    int end = 0;
    while (process_ > 0 && ::waitpid(process_, &end, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return end;
  }

  fs::path file_;
  ::pid_t process_ = -1;
  int questions_ = -1, answers_ = -1;
  Clock::time_point deadline_;
  std::vector<double> times_;
  std::optional<std::size_t> last_;  ///< the instant of the blocks
  std::vector<ForeignBlock> blocks_;
};

ForeignFile::ForeignFile(const fs::path& file) : reader_(std::make_unique<Reader>(file)) {}

ForeignFile::~ForeignFile() = default;

const fs::path& ForeignFile::file() const {
  return reader_->file();
}

const std::vector<double>& ForeignFile::times() const {
  return reader_->times();
}

std::vector<ForeignBlock> ForeignFile::blocks(std::size_t instant) const {
  return reader_->blocks(instant);
}

}  // namespace burnish
