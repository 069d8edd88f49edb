#pragma once
#include <json/value.h>

#include <string>
#include <vector>

#include "cli/jobs/job_pool.h"
#include "cli/jobs/study_plan.h"

namespace burnish {

/// What became of the runs of a study, a line for each, for people.
std::string runsTable(const StudyPlan& plan, const std::vector<JobStatus>& jobs);

/// The same as a list of JSON objects, the numbers as in the summaries of the runs.
Json::Value runsJson(const StudyPlan& plan, const std::vector<JobStatus>& jobs);

/// The same as CSV, the numbers as in the summaries of the runs.
std::string runsCsv(const StudyPlan& plan, const std::vector<JobStatus>& jobs);

}  // namespace burnish
