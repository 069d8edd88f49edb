#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/command.h"

namespace burnish {

/// A run of this very program in a process of its own.
struct Job {
  std::vector<std::string> arguments;
  std::filesystem::path log;         ///< receives everything that the process prints
  double cost = 0.0;                 ///< in any unit; what is expensive begins first
  std::vector<std::size_t> after{};  ///< jobs before this one that must have gone well
};

enum class JobState { Waiting, Running, Fine, Failed, Skipped, Interrupted };

struct JobStatus {
  JobState state = JobState::Waiting;
  int exitCode = 0;    ///< of a process that ended by itself
  int signal = 0;      ///< that ended the process, or 0
  double start = 0.0;  ///< seconds after the first job began
  double end = 0.0;
  std::size_t blockedBy = 0;  ///< of a skipped job: the job that failed
};

/// Is told what happens in the pool.
class JobObserver {
 public:
  virtual ~JobObserver() = default;
  virtual void onEnd(std::size_t job, const std::vector<JobStatus>& all) = 0;
  /// Many times a second.
  virtual void onWait(const std::vector<JobStatus>& all) = 0;
};

struct PoolResult {
  std::vector<JobStatus> jobs;
  int signal = 0;  ///< SIGINT or SIGTERM if one of them ended the work, else 0
};

/// Works off the jobs, some at a time. Jobs that fail (any exit code but those of a finished run) do not stop
/// the others, but those that need them are skipped. On SIGINT or SIGTERM the processes are told to end and
/// waited for. Throws `Error` if a log cannot be written or a process cannot be started.
PoolResult runJobs(const std::vector<Job>& jobs, int atOnce, JobObserver& observer);

/// Says on standard error that a signal has ended the work of a pool; the exit code of a command for it.
ExitCode interrupted(int signal);

}  // namespace burnish
