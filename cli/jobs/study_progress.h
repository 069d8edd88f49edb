#pragma once
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "cli/jobs/job_pool.h"
#include "cli/jobs/study_plan.h"

namespace burnish {

/// Shows on standard output how a study gets on: a line for every job that has ended and, on a terminal,
/// below them the jobs that go on and the expected rest, written over in place.
class StudyProgress : public JobObserver {
 public:
  /// The plan must outlive the object.
  explicit StudyProgress(const StudyPlan& plan);
  ~StudyProgress() override { clear(); }
  StudyProgress(const StudyProgress&) = delete;
  StudyProgress& operator=(const StudyProgress&) = delete;

  void onEnd(std::size_t job, const std::vector<JobStatus>& all) override;
  void onWait(const std::vector<JobStatus>& all) override;

 private:
  /// What a job is about; one of the two.
  struct Subject {
    const PlannedRun* run = nullptr;
    const PlannedFigure* figure = nullptr;
  };

  std::string name(std::size_t job) const;
  std::string endText(std::size_t job, const std::vector<JobStatus>& all) const;
  std::string runningText(std::size_t job, double seconds) const;
  std::string overallText(const std::vector<JobStatus>& all, double seconds) const;
  /// Part of a run that is done, from the last row of its history.
  double shareDone(std::size_t job, const JobStatus& status) const;
  void clear();

  const StudyPlan& plan_;
  std::vector<Subject> subjects_;
  bool terminal_;
  int linesShown_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point lastShown_{};
};

/// That, or one that shows nothing.
std::unique_ptr<JobObserver> progressOf(const StudyPlan& plan, bool isShown);

}  // namespace burnish
