#include "cli/jobs/job_pool.h"

#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

#include "cli/console.h"
#include "cli/faults.h"
#include "cli/jobs/child_process.h"

namespace burnish {
namespace {

/// A run that stopped before its end has results, too, and so has one without some of its pictures.
bool isFine(int exitCode) {
  return exitCode == static_cast<int>(ExitCode::Fine) || exitCode == static_cast<int>(ExitCode::Stopped) ||
         exitCode == static_cast<int>(ExitCode::Incomplete);
}

class Pool {
 public:
  Pool(const std::vector<Job>& jobs, JobObserver& observer)
      : jobs_(jobs), observer_(observer), statuses_(jobs.size()), processes_(jobs.size(), 0) {}

  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  /// No process outlives the pool, whatever is thrown.
  ~Pool() {
    tell(SIGKILL);
    for (std::size_t i = 0; i < jobs_.size(); ++i)
      if (isRunning(i)) ::waitpid(processes_[i], nullptr, 0);
  }

  PoolResult work(int atOnce) {
    int signalsSeen = 0;
    while (true) {
      collect();
      if (signals_.count() > signalsSeen) {
        tell(signalsSeen == 0 ? SIGTERM : SIGKILL);
        signalsSeen = signals_.count();
      }
      if (signalsSeen == 0) fillUp(atOnce);
      if (numRunning() == 0) return {statuses_, signals_.signal()};
      observer_.onWait(statuses_);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

 private:
  bool isRunning(std::size_t i) const { return statuses_[i].state == JobState::Running; }

  int numRunning() const {
    return static_cast<int>(std::count_if(statuses_.begin(), statuses_.end(), [](const JobStatus& status) {
      return status.state == JobState::Running;
    }));
  }

  double now() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

  void tell(int signal) const {
    for (std::size_t i = 0; i < jobs_.size(); ++i)
      if (isRunning(i)) ::kill(processes_[i], signal);
  }

  /// Takes note of the processes that have ended.
  void collect() {
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (!isRunning(i)) continue;
      const std::optional<int> status = endOf(processes_[i]);
      if (!status) continue;
      JobStatus& job = statuses_[i];
      if (WIFSIGNALED(*status)) job.signal = WTERMSIG(*status);
      if (WIFEXITED(*status)) job.exitCode = WEXITSTATUS(*status);
      const bool fine = job.signal == 0 && isFine(job.exitCode);
      end(i, fine ? JobState::Fine : signals_.count() == 0 ? JobState::Failed : JobState::Interrupted);
    }
  }

  void end(std::size_t i, JobState state) {
    statuses_[i].state = state;
    statuses_[i].end = now();
    observer_.onEnd(i, statuses_);
  }

  /// Starts what can be started.
  void fillUp(int atOnce) {
    skipTheBlocked();
    while (numRunning() < atOnce) {
      const std::optional<std::size_t> next = mostExpensive();
      if (!next) return;
      statuses_[*next].start = now();
      processes_[*next] = startSelf(jobs_[*next].arguments, jobs_[*next].log);
      statuses_[*next].state = JobState::Running;
    }
  }

  /// A skipped job may block jobs in turn: what is needed stands before what needs it.
  void skipTheBlocked() {
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (statuses_[i].state != JobState::Waiting) continue;
      for (const std::size_t needed : jobs_[i].after) {
        const JobState state = statuses_[needed].state;
        if (state != JobState::Failed && state != JobState::Skipped) continue;
        statuses_[i].blockedBy = state == JobState::Failed ? needed : statuses_[needed].blockedBy;
        end(i, JobState::Skipped);
        break;
      }
    }
  }

  /// The most expensive job that waits for nothing.
  std::optional<std::size_t> mostExpensive() const {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      const bool ready = statuses_[i].state == JobState::Waiting &&
                         std::all_of(jobs_[i].after.begin(), jobs_[i].after.end(), [&](std::size_t needed) {
                           return statuses_[needed].state == JobState::Fine;
                         });
      if (ready && (!best || jobs_[i].cost > jobs_[*best].cost)) best = i;
    }
    return best;
  }

  const std::vector<Job>& jobs_;
  JobObserver& observer_;
  SignalGuard signals_{SecondSignal::Noted};
  std::vector<JobStatus> statuses_;
  std::vector<pid_t> processes_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

PoolResult runJobs(const std::vector<Job>& jobs, int atOnce, JobObserver& observer) {
  return Pool(jobs, observer).work(atOnce);
}

ExitCode interrupted(int signal) {
  printError("burnish: interrupted; what is finished is kept, the same command does the rest\n");
  return codeOfSignal(signal);
}

}  // namespace burnish
