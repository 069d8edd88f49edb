#pragma once
#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "engine/core/byte_stream.h"

namespace burnish::inline core {

/// Reads a file in a process of its own, with the readers of other libraries: on a damaged file these may end their process, come to
/// no end or take all memory.
class ReadingProcess {
 public:
  /// What is done there for a question: it is worked out, and how it is sent is returned. `Error`s that are thrown reach the one who asked; so
  /// does `std::bad_alloc`, which ends the process.
  using Send = std::function<void(const TakeBytes&)>;
  using Answer = std::function<Send(std::int64_t question)>;

  /// Starts the process. Throws `Error` if that is not possible.
  ReadingProcess(std::filesystem::path file, const Answer& answer);
  ~ReadingProcess();
  ReadingProcess(const ReadingProcess&) = delete;
  ReadingProcess& operator=(const ReadingProcess&) = delete;

  const std::filesystem::path& file() const { return file_; }

  /// Asks, and has the answer received. Throws `Error`, also if the process ends or takes too long, from then on always the same, and
  /// `Interrupted`.
  void ask(std::int64_t question, const std::function<void(const FillBytes&)>& receive);

 private:
  void fillWith(void* bytes, std::size_t count);
  [[noreturn]] void endWith(std::string why);
  void stop();
  int waitForEnd();

  std::filesystem::path file_;
  ::pid_t process_ = -1;
  int questions_ = -1, answers_ = -1;
  std::chrono::steady_clock::time_point deadline_;
  std::string end_;  ///< why there is no process any more
};

}  // namespace burnish::inline core
