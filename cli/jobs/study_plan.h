#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/jobs/job_pool.h"
#include "engine/scene/scene.h"
#include "postproc/study/run_outlook.h"
#include "postproc/study/study.h"

namespace burnish {

struct PlannedRun {
  const StudyRun* run = nullptr;
  std::filesystem::path directory;
  double endTime = 0.0;  ///< of the scene
  double cost = 0.0;     ///< expected, in no unit
  RunOutlook outlook;
  std::optional<std::size_t> job;  ///< none: up to date
};

struct PlannedFigure {
  const FigureSpec* figure = nullptr;
  std::optional<std::size_t> job;  ///< none: up to date
};

/// What belongs to a study, and the jobs for what is missing or out of date.
struct StudyPlan {
  std::vector<PlannedRun> runs;
  std::vector<PlannedFigure> figures;
  std::vector<Job> jobs;
};

/// Tells studies apart, also those with equal times of change. Throws `Error` if the file cannot be read.
std::string studyDigest(const std::filesystem::path& studyFile);

/// What a run costs, in no unit: components times entries per unknown times steps times N^1.5 in two
/// dimensions or N² in three for N functions, as a factorisation by nested dissection.
double expectedCost(const Scene& scene);

/// What the results of a run of the scene will have; builds its model for the columns of the history. What cannot be found out,
/// as the scene has no model, is left to the run.
RunOutlook outlookBefore(const Scene& scene);

/// Looks at what is there. `only`: these figures and the runs that they need; everything when empty. A run
/// gets its share of the processors when `atOnce` go on at a time. Throws `Error` for figures that do not
/// exist.
StudyPlan planStudy(const Study& study, const std::filesystem::path& directory,
                    const std::vector<std::string>& only, int atOnce);

/// Throws `Error` with the places of what the study asks for that the results of these runs will not have.
void requireOutlooks(const Study& study, const StudyPlan& plan);

/// Makes the directories that jobs write to and removes what jobs will replace, so that nothing of an earlier
/// study passes for a part of this one.
void prepareJobs(const StudyPlan& plan, const std::filesystem::path& directory);

/// Draws a figure now, in place of what was drawn before, and keeps a record of its files.
void drawAndRecord(const Study& study, const FigureSpec& figure, const std::filesystem::path& directory);

/// Files of a figure that was drawn; none if it was not.
std::vector<std::filesystem::path> drawnFiles(const std::filesystem::path& directory,
                                              const std::string& figure);

/// The figure of that name. Throws `Error` if there is none.
const FigureSpec& findFigure(const Study& study, const std::string& name);

}  // namespace burnish
