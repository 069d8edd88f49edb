#include "engine/analysis/run_output.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "engine/core/error.h"
#include "engine/results/check_records.h"
#include "engine/results/result_reader.h"

namespace burnish {

RunOutput::RunOutput(const std::filesystem::path& directory, ModelRecord model,
                     const std::vector<std::string>& columns, bool resumes, bool countsLinear,
                     RunObserver& observer)
    : directory_(directory),
      model_(std::move(model)),
      files_(directory, model_, columns, resumes, countsLinear),
      countsLinear_(countsLinear),
      observer_(observer) {}

void RunOutput::showAgain() {
  const ResultReader result(directory_);
  for (int k = 0; k < result.numFrames(); ++k) observer_.onFrame(model_, result.frame(k));
}

template <int Dim>
void RunOutput::appendRow(const Recorder<Dim>& recorder, int step, int iterations) {
  const std::vector<double> row = recorder.row(step, iterations);
  for (std::size_t column = 0; column < row.size(); ++column)
    if (!std::isfinite(row[column]))
      throw RunError(
          fmt::format("{} is not finite at t = {:.6g}", recorder.columns()[column], recorder.current().time));
  files_.appendHistory(row);
  lastRowTime_ = recorder.current().time;
}

void RunOutput::appendConvergence(int number, const StepReport& step) {
  for (std::size_t k = 0; k < step.newton.history.size(); ++k) {
    std::vector<double> row{static_cast<double>(number), step.time, static_cast<double>(k),
                            step.newton.history[k]};
    if (countsLinear_) row.push_back(k > 0 ? static_cast<double>(step.newton.linearIterations[k - 1]) : 0.0);
    files_.appendConvergence(row);
  }
}

void RunOutput::accept(const FrameRecord& frame) {
  try {
    checkFrame(frame, model_, fmt::format("the frame at t = {:.6g}", frame.time));
  } catch (const Error& error) {
    throw RunError(error.what());
  }
  lastFrameTime_ = frame.time;
}

void RunOutput::append(const FrameRecord& frame, int steps, SavedState state) {
  files_.append(frame, steps, std::move(state));
  observer_.onFrame(model_, frame);
}

void RunOutput::appendLast(const FrameRecord& frame) {
  files_.appendLast(frame);
  observer_.onFrame(model_, frame);
}

void RunOutput::archive(StateArchive& archive) {
  archive.field("last_frame_time", lastFrameTime_);
  archive.field("last_row_time", lastRowTime_);
}

template void RunOutput::appendRow(const Recorder<2>&, int, int);
template void RunOutput::appendRow(const Recorder<3>&, int, int);

}  // namespace burnish
